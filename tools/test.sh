#!/usr/bin/env bash
# Installs the packages that are missing, builds with warnings as errors, and runs the tests: all suites under
# AddressSanitizer and UndefinedBehaviorSanitizer; as users build the program, those whose results may depend on optimization,
# time or memory, and those with the tag [long]; those of several threads under ThreadSanitizer; the fuzzers, half a minute each.
# With the name of a CMake preset (release, debug, asan-ubsan or tsan) it runs all tests of that preset instead. The last lines
# name the tests that this machine could not run, and why.
set -euo pipefail
cd "$(dirname "$0")/.."

build() { # preset, targets...
    cmake --preset "$1" -DGLOBULAR_TESTS=ON -DGLOBULAR_WERROR=ON
    # Beside suites a build yields: threads of a suite wait for each other, and one without a core would hold all up.
    nice cmake --build --preset "$1" ${2:+--target "${@:2}"}
}

# Prints which tests were skipped, from the logs of the runs that this script started. A skipped test prints "skipped: ", its
# name and the reason.
report_skipped() {
    local log reason
    for log in build/*/Testing/Temporary/LastTest.log; do
        [ "$log" -nt "$started" ] || continue
        sed -n 's/^ *\(skipped: .*\)/\1/p' "$log" | sort -u | while read -r reason; do
            echo "${log#build/}: $reason" | sed 's,/Testing/Temporary/LastTest.log,,'
        done
    done
    rm -f "$started"
}
started=$(mktemp)
trap report_skipped EXIT

tools/setup.sh --tests
if [ $# -gt 0 ]; then
    build "$1"
    ctest --preset "$1"
    exit
fi

build release globular globular-mpi {engine,golden,memory,mesh,render,scenes,studies}_tests
# Processes that wait for each other take four times as long beside a build.
ctest --preset release -R '^mpi_tests$'
# The kill harness sleeps most of the time: beside the next build.
ctest --preset release --parallel 2 -R '^(engine|golden|memory|(engine|mesh|render|scenes|studies)_long|kill|hard_cases|slurm|parallel|openjd)_tests$' &
build tsan
wait $!
# In parallel runs sanitized suites keep to a core each: this one, too, though it is alone. Beside the build, because beside
# other suites two would have the same core.
ctest --preset tsan --parallel 2 &
build asan-ubsan
wait $!
ctest --preset asan-ubsan --parallel 2
tests/fuzz/run.sh 30
