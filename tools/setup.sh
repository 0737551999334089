#!/usr/bin/env bash
# Installs what globular needs from Debian: compilers, libraries, Mesa's software renderer, ffmpeg; and the packages that are
# named. Called by the scripts beside it; does nothing where everything is there.
set -euo pipefail

packages=(
    cmake ninja-build g++ pkg-config
    libtbb-dev libhwy-dev libeigen3-dev libglm-dev libstb-dev libisal-dev libfmt-dev libcli11-dev nlohmann-json3-dev
    libtomlplusplus-dev catch2 fonts-dejavu-core
    libosmesa6-dev libegl-dev libgl-dev libegl1 libgl1-mesa-dri
    ffmpeg gnuplot-nox clang libclang-rt-dev
    "$@"
)

missing=()
for package in "${packages[@]}"; do
    dpkg-query -W -f '${Status}' "$package" 2>/dev/null | grep -q '^install ok installed$' || missing+=("$package")
done
[ ${#missing[@]} -eq 0 ] && exit 0

root=()
if [ "$(id -u)" -ne 0 ]; then
    command -v sudo >/dev/null || { echo "error: install as root, or install sudo: ${missing[*]}" >&2; exit 1; }
    root=(sudo)
fi
echo "installing: ${missing[*]}" >&2
export DEBIAN_FRONTEND=noninteractive
"${root[@]}" apt-get update -qq
"${root[@]}" apt-get install -y -qq --no-install-recommends "${missing[@]}" >/dev/null
