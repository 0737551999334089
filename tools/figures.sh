#!/usr/bin/env bash
# Sets the machine up, builds the program, and renders the paper's figures, the four scenes and the README's strip to pictures
# and videos: with OpenGL, as the paper did, on Mesa's software renderer, or with the program's own renderer on the CPU.
# Usage: figures.sh [DIR] [--renderer cpu]; DIR is the folder to write to, by default out/.
set -euo pipefail
cd "$(dirname "$0")/.."

out=out renderer=opengl
while [ $# -gt 0 ]; do
    case $1 in
        --renderer) renderer=${2:?--renderer needs a value: cpu or opengl}; shift 2 ;;
        -*) echo "error: there is no option $1; usage: figures.sh [DIR] [--renderer cpu]" >&2; exit 2 ;;
        *) out=$1; shift ;;
    esac
done
tools/setup.sh
cmake --preset release -DGLOBULAR_TESTS=OFF
cmake --build --preset release
globular=build/release/tools/globular

"$globular" figures --renderer "$renderer" -o "$out/figures"
for scene in fountain liquid solid powder; do
    # Smaller than the scenes' own size: without a graphics card, a frame of transparent water of that size takes seconds.
    "$globular" render "$scene" --renderer "$renderer" --size 640x360 -o "$out/$scene" --video "$out/$scene.mp4"
done
"$globular" strip splash --renderer "$renderer" --size 400x225 -o "$out/strip.png"
echo "done: $out/figures/index.html and $out/{fountain,liquid,solid,powder}.mp4"
