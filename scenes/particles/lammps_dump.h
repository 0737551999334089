// LAMMPS dumps as text ("dump custom"), which LAMMPS' read_dump and rerun and OVITO read.
#pragma once

#include <string>
#include <string_view>

#include "scenes/particles/particle_frame.h"
#include "scenes/particles/particle_table.h"

namespace scenes {

/// A snapshot with the columns id type x y z vx vy vz radius mass, in SI units. Ids and types count from 1, as LAMMPS
/// wants them: a particle's id and the index of its material, each plus one. The time step is the frame number, and the
/// box is the extent of the particles, their radii included, without periodic boundaries.
std::string encodeLammpsDump(const ParticleFrame& frame);

/// Whether a file begins as a dump does.
bool isLammpsDump(std::string_view bytes);

/// Reads the last snapshot of a dump. Positions may be x y z, xu yu zu, or scaled by an orthogonal box; the material is
/// the type minus one.
/// @param fileName  for messages
/// @throws InputError that names the line
ParticleTable readLammpsDump(std::string_view bytes, const std::string& fileName);

}  // namespace scenes
