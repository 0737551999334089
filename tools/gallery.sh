#!/usr/bin/env bash
# Draws the README's pictures into docs/: a still of each of our own scenes, and a strip of moments of each figure of the
# paper. Needs the program, which figures.sh builds.
set -euo pipefail
cd "$(dirname "$0")/.."

globular=build/release/tools/globular
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

still() { # scene, frame at its still.time
    "$globular" render "$1" --frames "$2" --size 960x540 --quality final --quiet -o "$work/$1"
    cp "$work/$1/"frame-*.png "docs/$1.png"
}

still fountain 168
still liquid 48
still solid 72
still powder 171
still honey 180
still jam 45
still oil 90
still lava 195
still mud 75
still molten-metal 168
still sand 345
still cascade 180

for figure in 1 2 3 4; do
    "$globular" strip "figure-$figure" --size 360x270 --quiet -o "docs/figure-$figure-strip.png"
done
"$globular" strip splash --size 400x225 --quiet -o docs/strip.png
