#!/usr/bin/env bash
# Makes the pictures that the last run of golden_tests drew the new goldens. Look at them first. Takes the CMake preset that ran.
set -euo pipefail
cd "$(dirname "$0")"
actual=../../build/${1:-release}/tests/golden/actual
for figure in 1 2 3 4; do
    cp -v "$actual/figure-$figure.png" .
done
