#!/usr/bin/env bash
# Shares out the frames of a scene over a Slurm cluster: a job simulates, the tasks of an array draw the frames, and a last
# job checks them and makes the film. Run it on a file system that all nodes see, with globular on PATH. It prints the
# numbers of the three jobs.
# Usage: submit.sh SCENE FOLDER CHUNKS [OPTION...]; the options are those of `globular render`, such as --size 1920x1080.
set -euo pipefail

scene=$1 folder=$2 chunks=$3
shift 3
here=$(cd "$(dirname "$0")" && pwd)
mkdir -p "$folder"

simulate=$(sbatch --parsable --output="$folder/simulate.log" "$here/simulate.sbatch" "$scene" "$folder")
# Tasks that end with an error do not hold up the last job: it names the frames that are missing.
draw=$(sbatch --parsable --output="$folder/draw-%a.log" --dependency="afterok:$simulate" --array="0-$((chunks - 1))" \
    "$here/draw.sbatch" "$scene" "$folder" "$chunks" "$@")
film=$(sbatch --parsable --output="$folder/film.log" --dependency="afterany:$draw" "$here/film.sbatch" "$folder")
echo "$simulate $draw $film"
