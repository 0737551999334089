#!/usr/bin/env bash
# Sets the machine up, builds the program, and renders the paper's figures, the four scenes and the README's strip to pictures
# and videos. Takes the folder to write to, by default out/.
set -euo pipefail
cd "$(dirname "$0")/.."

out=${1:-out}
tools/setup.sh
cmake --preset release -DGLOBULAR_TESTS=OFF
cmake --build --preset release
globular=build/release/tools/globular

"$globular" figures -o "$out/figures"
for scene in fountain liquid solid powder; do
    "$globular" render "$scene" -o "$out/$scene" --video "$out/$scene.mp4"
done
"$globular" strip splash --size 400x225 -o "$out/strip.png"
echo "done: $out/figures/index.html and $out/{fountain,liquid,solid,powder}.mp4"
