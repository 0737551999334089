#!/usr/bin/env bash
# Kills runs of four scenes at random times with SIGKILL and resumes them until they are done, again and again. Every
# finished run must have the frames, the video and the state hash of a run that was never disturbed, byte for byte. Every
# other run is not killed before its first checkpoint, so that some runs resume from one on a machine of any speed.
# Usage: kill_harness.sh PROGRAM [KILLS] [SEED]; prints what it did; fails if a byte differs.
set -euo pipefail

program=$1
wanted=${2:-200}
RANDOM=${3:-1}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# Scenes with enough frames for many kills, small enough for one to take seconds.
scenes=(measured/fountain measured/liquid measured/solid measured/powder)

run() { # scene, folder, options...
    local scene=$1 folder=$2
    shift 2
    exec "$program" render "$scene" --size 96x54 --frames 0-40 --quiet --checkpoint 0.2 -o "$folder" \
        --video "$folder.mp4" "$@"
}

wait_for_checkpoint() { # folder, process that may end instead
    while ! compgen -G "$1/checkpoint-*.state" >/dev/null && kill -0 "$2" 2>/dev/null; do sleep 0.01; done
}

hash_of() { grep '"state_hash"' "$1/run.json"; }

differing() { # whole, resumed: names of the files that differ
    local file
    for file in "$1"/*.png; do
        cmp -s "$file" "$2/${file##*/}" || echo "${file##*/}"
    done
    [ "$(ls "$1"/*.png | wc -l)" = "$(ls "$2"/*.png | wc -l)" ] || echo "number of frames"
    cmp -s "$1.mp4" "$2.mp4" || echo "${2##*/}.mp4"
    [ "$(hash_of "$1")" = "$(hash_of "$2")" ] || echo "state hash"
}

kills=0 runs=0 differ=0 resumed=0
while [ "$kills" -lt "$wanted" ]; do
    scene=${scenes[runs % ${#scenes[@]}]}
    whole=$work/$(basename "$scene")
    folder=$work/again-$(basename "$scene")
    [ -d "$whole" ] || (run "$scene" "$whole")
    rm -rf "$folder" "$folder.mp4"
    code=137
    for time in 1 2 3; do
        [ "$kills" -lt "$wanted" ] || break
        (run "$scene" "$folder" --resume) 2>"$work/log" &
        child=$!
        if [ $((runs % 2)) -eq 0 ] && [ "$time" -eq 1 ]; then wait_for_checkpoint "$folder" "$child"; fi
        sleep "$(printf '0.%03d' $((RANDOM % 900 + 50)))"
        # A run that has ended by now is not counted as a kill.
        kill -KILL "$child" 2>/dev/null || true
        code=0
        wait "$child" 2>/dev/null || code=$?
        [ "$code" -eq 137 ] || break
        kills=$((kills + 1))
    done
    # After the last kill the run is resumed to its end.
    if [ "$code" -eq 137 ]; then
        code=0
        (run "$scene" "$folder" --resume) 2>"$work/log" || code=$?
    fi
    if [ "$code" -ne 0 ]; then
        echo "$scene ended with $code:" >&2
        tail -3 "$work/log" >&2
        exit 1
    fi
    runs=$((runs + 1))
    if grep -q '"resumed_from": [0-9]' "$folder/run.json"; then resumed=$((resumed + 1)); fi
    if ls -A "$folder" | grep -v -x -E '(frame-[0-9]+\.png|checkpoint-[0-9]+\.state|manifest\.json|run\.json)'; then
        echo "$scene left something behind" >&2
        exit 1
    fi
    for file in $(differing "$whole" "$folder"); do
        echo "$scene: $file differs" >&2
        differ=$((differ + 1))
    done
done
echo "$kills kills in $runs runs, $resumed of which went on from a checkpoint at last: $differ files differ"
[ "$differ" -eq 0 ] && [ "$resumed" -gt 0 ]
