// Extended XYZ files, as ASE and OVITO read and write them: a number of particles, a line of key=value pairs of which
// Properties names the columns, and a line for each particle.
#pragma once

#include <string>
#include <string_view>

#include "scenes/particles/particle_frame.h"
#include "scenes/particles/particle_table.h"

namespace scenes {

/// A frame without a Lattice, with Time in seconds, frame, simulation_hash and the names of the materials. The columns
/// are species, pos, velo, radius, mass, id, material, color (sRGB, 0 to 1) and birth_time. Every species is "X", the
/// chemists' sign for none: other readers take nothing but elements.
std::string encodeExtxyz(const ParticleFrame& frame);

/// Whether a file begins as an XYZ file does: with a whole number alone on its first line.
bool isExtxyz(std::string_view bytes);

/// Reads the last frame of a file. Without Properties the columns are species and pos, as in plain XYZ files. The names
/// of the species are in the table.
/// @param fileName  for messages
/// @throws InputError that names the line
ParticleTable readExtxyz(std::string_view bytes, const std::string& fileName);

}  // namespace scenes
