"""Checks the JSON Schema that `globular schema --json-schema` prints: it accepts every built-in scene, and rejects mistakes.

Usage: json_schema_test.py PROGRAM SCENES_FOLDER. It needs Python 3.11 or later and python3-jsonschema; without them it
prints one line that starts with "skipped: ".
"""

import copy
import json
import pathlib
import subprocess
import sys

try:
    import tomllib

    import jsonschema
except ImportError as error:
    print(f"skipped: {error}")
    sys.exit(0)

program, folder = sys.argv[1:]
schema = json.loads(subprocess.run([program, "schema", "--json-schema"], check=True, capture_output=True).stdout)
validator_class = jsonschema.validators.validator_for(schema)
validator_class.check_schema(schema)
validator = validator_class(schema)
failures = []

scenes = {path: tomllib.loads(path.read_text()) for path in sorted(pathlib.Path(folder).rglob("*.toml"))}
if len(scenes) < 20:
    failures.append(f"only {len(scenes)} scenes below {folder}")
for path, scene in scenes.items():
    for error in validator.iter_errors(scene):
        failures.append(f"{path} is rejected: {error.json_path}: {error.message}")

SCENE = {
    "title": "t",
    "duration": 2.0,
    "look": {"style": "metaballs"},
    "body": [{"shape": "ball", "radius": 0.5}],
    "emitter": [{"position": [0, 1, 0], "rate": 2.0}],
}
for scene in (SCENE, SCENE | {"fps": "30000/1001"}):
    if not validator.is_valid(scene):
        failures.append(f"{scene} is rejected")


def mistake(description, change):
    """Applies a change to a valid scene, after which the schema has to reject it."""
    scene = copy.deepcopy(SCENE)
    change(scene)
    if validator.is_valid(scene):
        failures.append(f"{description} is accepted")


mistake("an unknown key", lambda scene: scene.update(durations=2.0))
mistake("an unknown key of a table", lambda scene: scene.update(physics={"gravitation": [0, 0, 0]}))
mistake("an unknown key of a body", lambda scene: scene["body"][0].update(size=1.0))
mistake("a key of another shape", lambda scene: scene["body"][0].update(counts=[1, 1, 1]))
mistake("a missing key", lambda scene: scene.pop("title"))
mistake("a missing key of a body", lambda scene: scene["body"][0].pop("radius"))
mistake("a value below its range", lambda scene: scene.update(fps=0))
mistake("a value above its range", lambda scene: scene["look"].update(specular=1.5))
mistake("a value at an excluded bound", lambda scene: scene["body"][0].update(radius=0))
mistake("a wrong type", lambda scene: scene.update(fps="30"))
mistake("an unknown choice", lambda scene: scene["look"].update(style="balls"))
mistake("a vector of two numbers", lambda scene: scene.update(physics={"gravity": [0, -9.8]}))
mistake("a color without #", lambda scene: scene["look"].update(background_top="b4c4d4"))
mistake("a body that is not in a list", lambda scene: scene.update(body={"shape": "ball", "radius": 0.5}))

print("\n".join(failures) or f"{len(scenes)} scenes are accepted, the mistakes are rejected")
sys.exit(bool(failures))
