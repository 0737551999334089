#!/usr/bin/env bash
# Sets the machine up, builds with warnings as errors, and runs the tests: as users build the program; those of the libraries
# under AddressSanitizer and UndefinedBehaviorSanitizer (the renderer's, the longest, only there); the fuzzers, a minute each;
# the engine's under ThreadSanitizer. With the name of a CMake preset (release, debug, asan-ubsan or tsan): all tests of it.
set -euo pipefail
cd "$(dirname "$0")/.."

build() { # preset, targets...
    cmake --preset "$1" -DGLOBULAR_TESTS=ON -DGLOBULAR_WERROR=ON
    cmake --build --preset "$1" ${2:+--target "${@:2}"}
}

tools/setup.sh
if [ $# -gt 0 ]; then
    build "$1"
    exec ctest --preset "$1"
fi

build release
ctest --preset release --parallel 2 -E '^render_tests$'
libraries=(engine render scenes)
build asan-ubsan "${libraries[@]/%/_tests}"
build tsan
# Side by side: the engine's suite is the longest of each and uses one core.
ctest --preset tsan &
ctest --preset asan-ubsan --parallel 2 -R "^($(IFS='|'; echo "${libraries[*]}"))_tests$"
wait $!
tests/fuzz/run.sh 60
