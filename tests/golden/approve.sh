#!/usr/bin/env bash
# Makes the pictures that the last run of golden_tests drew the new goldens. Look at the report first. Takes the CMake preset that
# ran (default: release), then names of pictures (default: all) or --force. Again, all of them:
#   cmake --build --preset release; ctest --preset release -R golden_tests; tests/golden/approve.sh
set -euo pipefail
cd "$(dirname "$0")"
build=../../build/${1:-release}
exec "$build/tools/globular" approve "$build/tests/golden/actual" frames "${@:2}"
