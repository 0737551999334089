#!/usr/bin/env bash
# Runs examples/parallel.sh, and compares its frames and film byte for byte with those of a run that was not shared out. Says
# why and exits with 77 where GNU parallel is not installed.
# Usage: parallel_test.sh PROGRAM
set -euo pipefail

program=$(realpath "$1")
here=$(cd "$(dirname "$0")" && pwd)
command -v parallel >/dev/null || { echo "skipped: parallel_tests: there is no GNU parallel (Debian: parallel)"; exit 77; }
PATH=$(dirname "$program"):$PATH
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

sed 's/^\[look\]/&\nsize = [160, 90]/' "$here/drops.toml" >"$work/drops.toml"
globular render "$work/drops.toml" -o "$work/direct" --video "$work/direct.mp4" --quiet
"$here/../../examples/parallel.sh" "$work/drops.toml" "$work/job" 5 --jobs 2
for frame in "$work"/direct/*.png; do
    cmp "$frame" "$work/job/frames/${frame##*/}"
done
cmp "$work/direct.mp4" "$work/job/film.mp4"
