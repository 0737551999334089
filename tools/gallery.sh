#!/usr/bin/env bash
# Draws the pictures of README.md and docs/ into docs/: the first scene as a moving picture and with one key changed at a time,
# the stills and the numbers of docs/gallery.md (scenes that out/gallery has already are not drawn again), and a strip of moments of
# each figure of the paper. Needs the program, which figures.sh builds. With names (first, keys, constants, shapes, scenes, loads,
# figures, splash, two-liquids, chocolate, blur) it draws these alone.
set -euo pipefail
cd "$(dirname "$0")/.."

globular=build/release/tools/globular
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

wanted() { # name: whether to draw it
    [ -z "${names:-}" ] || [[ " $names " == *" $1 "* ]]
}
names="$*"

# Finer particles for docs/first.toml (docs/model.md, "Finer particles").
finer=(--set resolution=1.6)

if wanted first; then
    "$globular" render docs/first.toml "${finer[@]}" --frames 8-176 --size 800x450 --quality final --quiet -o "$work/first"
    ffmpeg -v error -y -framerate 30 -start_number 8 -i "$work/first/frame-%05d.png" -loop 0 -c:v libwebp_anim -quality 75 \
        -compression_level 6 docs/first.webp
fi

labelled() { # scene, frame, picture, label, options of render: the frame with the label on it, 320x180
    local folder="$work/labelled" font=/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf
    rm -rf "$folder"
    "$globular" render "$1" "${@:5}" --frames "$2" --size 320x180 --quality final --quiet -o "$folder"
    ffmpeg -v error -y -i "$folder/frame-$(printf %05d "$2").png" \
        -vf "drawtext=text='$4':x=6:y=18-max_glyph_a:fontcolor=white:fontsize=13:fontfile=$font" "$3"
}

variations=0
variation() { # label, options of render: the first scene with its label on it
    labelled docs/first.toml 130 "$work/variations-$(printf %02d "$variations").png" "$@"
    variations=$((variations + 1))
}

constants=0
constant() { # key of the material, three values, options of render: a row of three pictures of docs/constants.toml
    local value
    for value in $2; do
        labelled docs/constants.toml 36 "$work/constants-$(printf %02d "$constants").png" "$1 = $value" \
            --set "material.$1=$value" "${@:3}"
        constants=$((constants + 1))
    done
}

if wanted keys; then
    variation "docs/first.toml"
    variation "bd = 30" --set material.bd=30
    variation "bd = 1" --set material.bd=1
    variation "bd = 1, cr = 2" --set material.bd=1 --set material.cr=2
    variation "mass = 0.2" --set material.mass=0.2
    variation "finer" "${finer[@]}"
    variation "spheres" --set look.style=spheres --set look.transparency=0
    variation "dry" --set look.specular=0 --set look.reflection=0 --set look.transparency=0
    variation "metal" --set look.metal=1 --set look.transparency=0 --set look.reflection=2 --set look.mirror_top=[1.2,1.2,1.2]
    variation "by speed" --set look.transparency=0 --set look.color_by=speed --set look.color_map=ember --set look.color_range=[0,4]
    ffmpeg -v error -y -i "$work/variations-%02d.png" -vf tile=5x2:padding=4 -frames:v 1 -c:v libwebp -quality 85 docs/keys.webp
fi

if wanted constants; then
    constant b1 "0.00005 0.0015 0.02"
    constant bd "0.02 0.25 4"
    # Less of it, on an open floor: the tank is far away.
    constant cr "1 1.3 1.6" --set "body[0].minimum=[-0.5,0,-0.3]" --set "body[0].maximum=[0.2,1,0.3]" \
        --set "obstacle[1].minimum=[-9,0,-9]" --set "obstacle[1].maximum=[9,9,9]" --set "obstacle[1].edges=false"
    constant cd "1 2 3"
    constant friction "0 0.3 0.8" --set material.preset=sand --set look.style=spheres
    constant radius "0.12 0.08 0.04" --set look.style=spheres
    ffmpeg -v error -y -i "$work/constants-%02d.png" -vf tile=3x6:padding=4 -frames:v 1 -c:v libwebp -quality 85 \
        docs/constants.webp
fi

shapes=0
shape() { # table, frame, shape, its keys: a picture of docs/shapes.toml or, in place of its body, docs/bodies.toml
    local base=docs/shapes.toml
    [ "$1" = body ] && base=docs/bodies.toml
    { sed '/^\[\[body\]\]/,$d' "$base"; printf '\n[[%s]]\nshape = "%s"\n%s\n' "$1" "$3" "${4//; /$'\n'}"; } > "$work/shape.toml"
    labelled "$work/shape.toml" "$2" "$work/shapes-$(printf %02d "$shapes").png" "$3"
    shapes=$((shapes + 1))
}
obstacle() { # shape, its keys
    shape obstacle 50 "$1" "$2; friction = 0.3"
}
body() { # shape, its keys
    shape body 0 "$@"
}
sheet() { # columns x rows, picture: the pictures of shapes since the last sheet
    ffmpeg -v error -y -i "$work/shapes-%02d.png" -vf "tile=$1:padding=4" -frames:v 1 -c:v libwebp -quality 85 "$2"
    rm "$work"/shapes-*.png
    shapes=0
}

if wanted shapes; then
    cp scenes/library/star.obj "$work/"
    # A heart in black on white.
    ffmpeg -v error -y -f lavfi -i color=white:s=200x200,format=gray -vf \
        "geq=lum='255*gt(pow(pow((X-100)/70,2)+pow((95-Y)/70,2)-1,3)-pow((X-100)/70,2)*pow((95-Y)/70,3),0)'" \
        -frames:v 1 "$work/heart.png"
    bowl='profile = [[0, 0.1], [0.5, 0.1], [0.8, 0.5], [0.9, 1]]'

    obstacle plane 'normal = [0.2, 1, 0]'
    obstacle box 'center = [0, 0.5, 0]; size = [1, 1, 1]; rotation = [0, 30, 0]'
    obstacle container 'minimum = [-0.7, 0, -0.6]; maximum = [0.7, 2.7, 0.6]'
    obstacle sphere 'center = [0, 0.6, 0]; radius = 0.6'
    obstacle cylinder 'center = [0, 0.5, 0]; radius = 0.6; height = 1'
    obstacle cone 'center = [0, 0.6, 0]; radius = 0.8; height = 1.2'
    obstacle frustum 'center = [0, 0.5, 0]; radius = 0.8; top_radius = 0.4; height = 1'
    obstacle capsule 'center = [0, 0.6, 0]; radius = 0.4; height = 1.8; rotation = [0, 30, 90]'
    obstacle revolution "$bowl; thickness = 0.12"
    obstacle mesh 'file = "star.obj"; center = [0, 0.8, 0]; rotation = [15, 0, 0]'
    sheet 5x2 docs/shapes.webp

    body box 'minimum = [-0.6, 0, -0.5]; maximum = [0.6, 1, 0.5]'
    body ball 'center = [0, 0.7, 0]; radius = 0.7'
    body grid 'center = [0, 0.6, 0]; counts = [9, 9, 9]; spacing = 0.13'
    body cylinder 'center = [0, 0.6, 0]; radius = 0.6; height = 1.2'
    body cone 'center = [0, 0.6, 0]; radius = 0.8; height = 1.2'
    body frustum 'center = [0, 0.5, 0]; radius = 0.8; top_radius = 0.4; height = 1'
    body capsule 'center = [0, 0.5, 0]; radius = 0.4; height = 1.8; rotation = [0, 30, 90]'
    body shell 'center = [0, 0.7, 0]; radius = 0.7; thickness = 0.1'
    body revolution "$bowl; thickness = 0.2"
    body mesh 'file = "star.obj"; center = [0, 0.95, 0]; rotation = [60, 0, 0]'
    body text 'text = "abc"; center = [0, 0.62, 0]; height = 1.1; depth = 0.4'
    body image 'file = "heart.png"; center = [0, 0.75, 0]; width = 1.8; depth = 0.4'
    sheet 6x2 docs/bodies.webp
fi

if wanted scenes; then
    "$globular" gallery -o out/gallery --size 1280x720 --quiet --markdown > "$work/gallery.md"
    mkdir -p docs/paper
    # Stills of two thirds of the films' size, which pages show in full.
    for still in out/gallery/*.png out/gallery/paper/*.png; do
        ffmpeg -v error -y -i "$still" -vf scale=960:-1:flags=area "docs/${still#out/gallery/}"
    done
    cp "$work/gallery.md" docs/gallery.md
fi

if wanted figures; then
    for figure in 1 2 3 4; do
        "$globular" strip "figure-$figure" --size 360x270 --quiet -o "docs/figure-$figure-strip.png"
    done
fi
if wanted loads; then
    "$globular" simulate mixer --quiet -o "$work/loads"
    "$globular" plot "$work/loads" --quiet -o docs/loads.png
fi
if wanted two-liquids; then
    "$globular" strip docs/two-liquids.toml --size 320x240 --quiet -o docs/two-liquids.png
fi
if wanted splash; then
    "$globular" strip splash --size 400x225 --quiet -o docs/strip.png
fi
if wanted chocolate; then
    "$globular" strip chocolate --size 400x225 --quiet -o docs/chocolate-strip.png
fi
if wanted blur; then
    for still in rotor:72 beads:0; do
        scene=${still%:*} frame=${still#*:}
        "$globular" render "examples/scenes/$scene.toml" --frames "$frame" --size 640x360 --quality final --quiet -o "$work/$scene"
        ffmpeg -v error -y -i "$work/$scene/frame-$(printf %05d "$frame").png" -c:v libwebp -quality 85 "docs/$scene.webp"
    done
fi
