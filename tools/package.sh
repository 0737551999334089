#!/usr/bin/env bash
# Sets the machine up, builds the program, and makes a Debian package of it: build/release/globular_VERSION_ARCHITECTURE.deb.
# `apt-get install ./globular_*.deb` then installs it with what it needs.
set -euo pipefail
cd "$(dirname "$0")/.."

# CPack finds the libraries' packages by dpkg-shlibdeps, and asks `file` which files are programs.
tools/setup.sh dpkg-dev file
cmake --preset release -DGLOBULAR_TESTS=OFF
cmake --build --preset release --target package
