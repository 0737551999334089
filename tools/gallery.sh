#!/usr/bin/env bash
# Draws the pictures of README.md and docs/ into docs/: the moving picture of the first scene, a still of each scene of the
# library's top folder, and a strip of moments of each figure of the paper. Needs the program, which figures.sh builds.
# With names (first, figures, splash or scenes such as honey): draws these alone.
set -euo pipefail
cd "$(dirname "$0")/.."

globular=build/release/tools/globular
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

wanted() { # name: whether to draw it
    [ -z "${names:-}" ] || [[ " $names " == *" $1 "* ]]
}
names="$*"

still() { # scene, frame at its still.time
    wanted "$1" || return 0
    "$globular" render "$1" --frames "$2" --size 960x540 --quality final --quiet -o "$work/$1"
    cp "$work/$1/"frame-*.png "docs/$1.png"
}

# The first scene of the README with finer particles: the same substance and the same jet (docs/model.md, "Finer particles").
if wanted first; then
    "$globular" render docs/first.toml --set material.radius=0.05 --set material.mass=0.0122 --set material.b1=0.000179 \
        --set material.bd=5 --set "emitter[0].interval=0.034" --frames 8-176 --size 800x450 --quality final --quiet \
        -o "$work/first"
    ffmpeg -v error -y -framerate 30 -start_number 8 -i "$work/first/frame-%05d.png" -loop 0 -c:v libwebp_anim -quality 75 \
        -compression_level 6 docs/first.webp
fi

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

if wanted figures; then
    for figure in 1 2 3 4; do
        "$globular" strip "figure-$figure" --size 360x270 --quiet -o "docs/figure-$figure-strip.png"
    done
fi
if wanted splash; then
    "$globular" strip splash --size 400x225 --quiet -o docs/strip.png
fi
