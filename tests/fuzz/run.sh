#!/usr/bin/env bash
# Fuzzes everything that reads bytes from outside, all targets side by side, with AddressSanitizer and
# UndefinedBehaviorSanitizer. Usage: run.sh [SECONDS] (default: 60). What is found is left in build/asan-ubsan/fuzz/found;
# the corpora in tests/fuzz/corpus are read and not changed.
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
    # What was learned in earlier runs comes first; the repository's corpus is the seed. A minute for one input: where two
    # grains meet hard, the automatic stepper takes some 70,000 passes for its first looks, which is not yet endless.
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
