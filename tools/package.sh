#!/usr/bin/env bash
# Sets the machine up, builds the programs, and makes Debian packages of them: build/release/globular_VERSION_ARCHITECTURE.deb,
# and beside it globular-mpi_VERSION_ARCHITECTURE.deb, which needs the first one. `apt-get install ./globular_*.deb` then installs
# globular with what it needs, and `apt-get install ./globular*.deb` both.
set -euo pipefail
cd "$(dirname "$0")/.."

# CPack finds the libraries' packages by dpkg-shlibdeps, and asks `file` which files are programs.
tools/setup.sh dpkg-dev file
cmake --preset release -DGLOBULAR_TESTS=OFF
cmake --build --preset release --target package
