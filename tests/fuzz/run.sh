#!/usr/bin/env bash
# Fuzzes all code that reads bytes from outside the program, all targets in parallel, with AddressSanitizer and
# UndefinedBehaviorSanitizer. Usage: run.sh [SECONDS] (default: 60). Inputs that fail are written to
# build/asan-ubsan/fuzz/found; the corpora in tests/fuzz/corpus are read but not changed.
set -euo pipefail
cd "$(dirname "$0")/../.."

seconds=${1:-60}
targets=(scene overrides particle_file checkpoint png manifest)
cmake --preset asan-ubsan
cmake --build --preset asan-ubsan --target "${targets[@]/#/fuzz_}"

mkdir -p build/asan-ubsan/fuzz/found
cd build/asan-ubsan/fuzz
for target in "${targets[@]}"; do
    mkdir -p "corpus/$target"
    # The first folder collects the inputs that earlier runs have found; the repository's corpus is the seed. An input may
    # take a minute: where two particles collide hard, the automatic stepper needs about 70,000 force evaluations for its
    # first error estimates.
    "../tests/fuzz/fuzz_$target" "corpus/$target" "../../../tests/fuzz/corpus/$target" -max_total_time="$seconds" \
        -rss_limit_mb=2048 -timeout=60 -max_len=16384 -artifact_prefix="found/$target-" -print_final_stats=1 \
        -verbosity=0 >"$target.log" 2>&1 &
done
failed=0
for job in $(jobs -p); do wait "$job" || failed=1; done
for target in "${targets[@]}"; do
    executed=$(sed -n 's/^stat::number_of_executed_units: *//p' "$target.log")
    echo "$target: ${executed:-?} inputs in $seconds s"
    grep -E 'ERROR|SUMMARY|runtime error' "$target.log" || true
done
exit "$failed"
