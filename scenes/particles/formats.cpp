// The table of formats. A new one takes a row here and, if it is to be read as well, a line in decodeParticles().
#include "scenes/particles/formats.h"

#include <array>

#include "scenes/particles/extxyz.h"
#include "scenes/particles/lammps_dump.h"
#include "scenes/particles/particle_file.h"
#include "scenes/particles/ply.h"
#include "scenes/particles/vtp.h"

namespace scenes {
namespace {

std::string encodePly(const ParticleFrame& frame) {
    return encodeParticles(frame.particles, frame.stamp);
}

constexpr std::array kFormats = {
    ParticleFormat{"ply", "particles-", ".ply", "PLY in double precision", encodePly},
    ParticleFormat{"ply-float", "particles-float-", ".ply", "PLY in single precision (splashsurf, VTK, Blender)",
                   encodePlyFloat},
    ParticleFormat{"vtp", "particles-", ".vtp", "VTK PolyData, with a series of times (ParaView)", encodeVtp},
    ParticleFormat{"extxyz", "particles-", ".xyz", "extended XYZ (ASE, OVITO)", encodeExtxyz},
    ParticleFormat{"lammps", "particles-", ".lammpstrj", "LAMMPS dump as text (LAMMPS, OVITO)", encodeLammpsDump}};

}  // namespace

std::span<const ParticleFormat> particleFormats() {
    return kFormats;
}

}  // namespace scenes
