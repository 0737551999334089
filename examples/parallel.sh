#!/usr/bin/env bash
# Draws a scene in parts with GNU parallel, one part for each core: on this machine, or on those of a file that lists them
# (--sshloginfile, with FOLDER and SCENE under the same names on all of them). Run again, it draws what is missing.
# Usage: parallel.sh SCENE FOLDER CHUNKS [OPTION OF PARALLEL...]
set -euo pipefail

scene=$1 folder=$2 chunks=$3
shift 3
globular simulate "$scene" -o "$folder/states" --resume --quiet
seq "$chunks" | parallel --retries 3 "$@" globular render "$scene" --states "$folder/states" -o "$folder/frames" \
    --chunk "{}/$chunks" --resume --threads 1 --quiet
globular assemble "$folder/frames" -o "$folder/film.mp4"
