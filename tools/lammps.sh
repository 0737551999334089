#!/usr/bin/env bash
# Builds what `globular study scaling --peer lammps` runs of LAMMPS, from Debian's sources with Debian's flags for
# the compiler: `dpd`, which Debian's package leaves out, too. Then:
#   PATH=$PWD/build/lammps:$PATH build/release/tools/globular study scaling --peer lammps
set -euo pipefail
cd "$(dirname "$0")/.."

tools/setup.sh dpkg-dev openmpi-bin libopenmpi-dev
build=$PWD/build/lammps
mkdir -p "$build"/apt/{parts,lists/partial,cache/archives/partial} "$build/source"

if [ ! -d "$build/source/lammps" ]; then
    # Where this machine's packages come from their sources do, too.
    for list in /etc/apt/sources.list /etc/apt/sources.list.d/*.{list,sources}; do
        [ -e "$list" ] || continue
        sed -E 's/^deb( |\t)/deb-src\1/; s/^Types:.*/Types: deb-src/' "$list" >"$build/apt/parts/${list##*/}"
    done
    apt=(-o Dir::Etc::sourcelist=/dev/null -o "Dir::Etc::sourceparts=$build/apt/parts" -o APT::Sandbox::User=root
        -o "Dir::State::Lists=$build/apt/lists" -o "Dir::Cache=$build/apt/cache")
    apt-get "${apt[@]}" -qq update || true # whoever has no sources is not needed
    rm -rf "$build"/source/*
    (cd "$build/source" && apt-get "${apt[@]}" -qq source --download-only lammps)
    dpkg-source --skip-debianization --no-check -x "$build"/source/lammps_*.dsc "$build/source/unpacked"
    mv "$build/source/unpacked" "$build/source/lammps"
fi

cmake -S "$build/source/lammps/cmake" -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=None \
    -DCMAKE_CXX_FLAGS="$(dpkg-buildflags --get CXXFLAGS) $(dpkg-buildflags --get CPPFLAGS) -w" \
    -DBUILD_MPI=ON -DPKG_OPT=ON -DPKG_DPD-BASIC=ON -DBUILD_OMP=OFF -DWITH_{JPEG,PNG,GZIP,FFMPEG}=OFF
cmake --build "$build" --target lmp
