#!/usr/bin/env bash
# Installs the Debian packages that globular is built with and runs with: compiler, libraries, Mesa's software renderer,
# ffmpeg. Called by the scripts beside it.
# Usage: setup.sh [--tests] [PACKAGE...]; --tests adds what the tests need besides; further packages are installed as well.
set -euo pipefail

# OpenVDB makes the meshes of `globular mesh` and finds the distances from meshes of scenes, which assimp reads, and its headers
# include Boost's; OpenEXR writes the files of `globular render
# --format exr`; MPI and Zoltan share a run out in globular-mpi. The program can be built without, but the package and CI are to
# have what the documents describe.
packages=(
    cmake ninja-build g++ pkg-config
    libtbb-dev libhwy-dev libeigen3-dev libglm-dev libstb-dev libisal-dev libfmt-dev libcli11-dev nlohmann-json3-dev
    libtomlplusplus-dev fonts-dejavu-core
    libopenvdb-dev libboost-dev libopenexr-dev libassimp-dev
    libopenmpi-dev openmpi-bin libtrilinos-zoltan-dev
    libosmesa6-dev libegl-dev libgl-dev libegl1 libgl1-mesa-dri
    ffmpeg gnuplot-nox
)
if [ "${1:-}" = --tests ]; then
    shift
    # clang has the sanitizers and the fuzzer; llvm the symbolizer that puts names into their reports; chromium opens the
    # report of `globular compare`; python3-jsonschema checks the scenes against `globular schema --json-schema`; meshio, VTK,
    # LAMMPS and python3-openvdb read particle files, fields and meshes back, and the first three write some to be read; oiiotool
    # reads OpenEXR files back; Slurm (with munge), GNU parallel and python3-yaml run the jobs of examples/.
    packages+=(catch2 clang libclang-rt-dev llvm chromium python3-jsonschema python3-meshio python3-vtk9 lammps
        python3-openvdb openimageio-tools slurm-wlm munge parallel python3-yaml)
fi
exec "$(dirname "$0")/install_packages.sh" "${packages[@]}" "$@"
