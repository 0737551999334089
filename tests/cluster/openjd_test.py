# Runs the job of examples/openjd/globular.yaml as a render farm would: checks its keys against those of the template schema
# 2023-09 that it may have, shares its frames out in chunks, and runs the commands of the steps in the order of their
# dependencies. Frames and film must be those of a run that was not shared out, byte for byte. Prints "skipped" and exits
# with 77 where there is no Python module yaml.
# Usage: openjd_test.py PROGRAM
import pathlib
import re
import subprocess
import sys
import tempfile

try:
    import yaml
except ImportError:
    print("skipped: openjd_tests: there is no Python module yaml (Debian: python3-yaml)")
    sys.exit(77)

PROGRAM = sys.argv[1]
TEMPLATE = pathlib.Path(__file__).parents[2] / "examples" / "openjd" / "globular.yaml"

KEYS = {
    "template": {"specificationVersion", "extensions", "name", "parameterDefinitions", "steps"},
    "PATH": {"name", "type", "objectType", "dataFlow", "description"},
    "STRING": {"name", "type", "default", "description"},
    "INT": {"name", "type", "default", "minValue", "description"},
    "step": {"name", "script", "dependencies", "parameterSpace"},
    "CHUNK[INT]": {"name", "type", "range", "chunks"},
    "chunks": {"defaultTaskCount", "rangeConstraint"},
}


def check(kind, mapping):
    unknown = set(mapping) - KEYS[kind]
    assert not unknown, f"{kind} has unknown keys {unknown}"


def filled(text, values):
    """The text with each {{name}} replaced; a name without a value is an error."""
    return re.sub(r"\{\{\s*([\w.]+)\s*\}\}", lambda match: str(values[match.group(1)]), str(text))


def frames_of(text):
    """The numbers of a range expression such as 1-3,5,7-20:2."""
    numbers = set()
    for part in text.split(","):
        match = re.fullmatch(r"\s*(\d+)(?:-(\d+)(?::(\d+))?)?\s*", part)
        first, last, step = (match.group(1), match.group(2) or match.group(1), match.group(3) or 1)
        numbers.update(range(int(first), int(last) + 1, int(step)))
    return sorted(numbers)


def chunks_of(text, size):
    """Chunks as a farm hands them out: lists of single frames, and ranges where frames are neighbors."""
    numbers = frames_of(text)
    for at in range(0, len(numbers), size):
        part = numbers[at:at + size]
        isRange = len(part) > 1 and part[-1] - part[0] == len(part) - 1
        yield f"{part[0]}-{part[-1]}" if isRange else ",".join(map(str, part))


def run(arguments):
    subprocess.run([PROGRAM, *arguments], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)


def run_step(step, values):
    action = step["script"]["actions"]["onRun"]
    assert action["command"] == "globular"
    tasks = [values]
    for parameter in step.get("parameterSpace", {}).get("taskParameterDefinitions", []):
        check(parameter["type"], parameter)
        check("chunks", parameter["chunks"])
        assert parameter["chunks"]["rangeConstraint"] in ("CONTIGUOUS", "NONCONTIGUOUS")
        size = int(filled(parameter["chunks"]["defaultTaskCount"], values))
        tasks = [values | {f"Task.Param.{parameter['name']}": chunk}
                 for chunk in chunks_of(filled(parameter["range"], values), size)]
        assert len(tasks) > 1
    for task in tasks:
        run([filled(argument, task) for argument in action["args"]])


def values_of(template, given):
    values = {}
    for parameter in template["parameterDefinitions"]:
        check(parameter["type"], parameter)
        name = parameter["name"]
        values[f"Param.{name}"] = given.get(name, parameter.get("default"))
        assert values[f"Param.{name}"] is not None, f"{name} has no value"
    return values


def main():
    template = yaml.safe_load(TEMPLATE.read_text())
    check("template", template)
    assert template["specificationVersion"] == "jobtemplate-2023-09"
    assert template["extensions"] == ["TASK_CHUNKING"]
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        frames = "0-5,8-14:2"
        values = values_of(template, {"Scene": "measured/liquid", "Folder": folder / "job", "Frames": frames, "FramesPerTask": 4,
                                      "Size": "160x90"})
        done = set()
        for step in template["steps"]:
            check("step", step)
            assert {each["dependsOn"] for each in step.get("dependencies", [])} <= done, "a step comes before another"
            run_step(step, values)
            done.add(step["name"])
        run(["render", "measured/liquid", "--frames", frames, "--size", "160x90", "-o", folder / "direct", "--video",
             folder / "direct.mp4"])
        for frame in frames_of(frames):
            name = f"frame-{frame:05}.png"
            assert (folder / "job/frames" / name).read_bytes() == (folder / "direct" / name).read_bytes(), name
        assert (folder / "job/film.mp4").read_bytes() == (folder / "direct.mp4").read_bytes(), "the film differs"
    print("the job of examples/openjd drew the frames and the film of a run that was not shared out")


main()
