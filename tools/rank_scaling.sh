#!/usr/bin/env bash
# Measures steps of globular-mpi on several ranks beside steps of globular on as many threads, and prints two tables in
# Markdown: blocks of liquid as large for any number of ranks (strong scaling), and as large for each rank (weak scaling).
# Medians of some rounds, in which all are run in turn.
#   tools/rank_scaling.sh BUILD [ROUNDS] [RANKS...]      (default: 5 rounds of 1, 2 and 4 ranks)
# MPIRUN may have mpirun and its options.
set -euo pipefail
build=$1
rounds=${2:-5}
ranks=("${@:3}")
[ ${#ranks[@]} -gt 0 ] || ranks=(1 2 4)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# block.toml: a block of liquid in a tank, as long as the first argument says, in units of about 47,000 particles.
scene() {
    cat > "$work/block-$1.toml" <<TOML
title = "A block of liquid"
duration = 1
fps = 30
[physics]
stepper = "symplectic-euler"
step = 0.002
[material]
preset = "liquid"
mass = 0.1
compression = 0.1
bd = 0.15
[[body]]
shape = "box"
minimum = [0, 0.15, 0]
maximum = [$(awk "BEGIN { print 6 * $1 }"), 9, 12]
spacing = 0.27
jitter = 0.08
[[obstacle]]
shape = "container"
minimum = [-1, 0, -1]
maximum = [$(awk "BEGIN { print 6 * $1 + 1 }"), 12, 13]
TOML
}

# Milliseconds a step of a run of three frames.
time_of() {
    rm -rf "$work/out"
    "$@" --frames 3 --quiet --no-error-estimate -o "$work/out"
    python3 - "$work/out/run.json" <<'PYTHON'
import json, sys
run = json.load(open(sys.argv[1]))
print(1e3 * run["seconds"]["simulating"] / run["steps"]["count"])
PYTHON
}

median() {
    sort -g "$1" | awk '{ a[NR] = $1 } END { print NR % 2 ? a[(NR + 1) / 2] : (a[NR / 2] + a[NR / 2 + 1]) / 2 }'
}

for size in 3 "${ranks[@]}"; do scene "$size"; done
for ((round = 0; round < rounds; ++round)); do
    for n in "${ranks[@]}"; do
        for kind in strong weak; do
            size=3
            [ $kind = strong ] || size=$n
            time_of "$build/tools/globular" simulate "$work/block-$size.toml" --threads "$n" >> "$work/$kind-threads-$n"
            time_of ${MPIRUN:-mpirun} -np "$n" "$build/mpi/globular-mpi" simulate "$work/block-$size.toml" \
                >> "$work/$kind-ranks-$n"
        done
    done
done
for kind in strong weak; do
    echo "| ranks or threads, $kind | threads, ms a step | ranks, ms a step | ranks over threads |"
    echo "|---|---|---|---|"
    for n in "${ranks[@]}"; do
        threads=$(median "$work/$kind-threads-$n")
        own=$(median "$work/$kind-ranks-$n")
        awk -v n="$n" -v t="$threads" -v r="$own" 'BEGIN { printf "| %d | %.2f | %.2f | %.2f |\n", n, t, r, r / t }'
    done
    echo
done
