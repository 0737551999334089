#!/usr/bin/env bash
# Sets the machine up, builds with warnings as errors, and runs every test. Takes the name of a CMake preset: release (the
# default), debug, asan-ubsan or tsan.
set -euo pipefail
cd "$(dirname "$0")/.."

preset=${1:-release}
tools/setup.sh
cmake --preset "$preset" -DGLOBULAR_TESTS=ON -DGLOBULAR_WERROR=ON
cmake --build --preset "$preset"
ctest --preset "$preset"
