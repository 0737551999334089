// PLY files (the Stanford polygon format) for other programs and of other programs: as text or binary of either byte
// order, with numbers of any type, beside properties, lists and elements that are not wanted. What `globular simulate`
// writes by default is in particle_file.h.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "scenes/particles/particle_frame.h"
#include "scenes/particles/particle_table.h"

namespace scenes {

/// The particles in single precision, little-endian: x y z vx vy vz radius mass birth_time as float, material and id as
/// int, and an element "face" without rows, which VTK's reader wants. Comments have the time (s), the number of the
/// frame and the hash of the scene.
std::string encodePlyFloat(const ParticleFrame& frame);

/// Whether a file begins as a PLY file does.
bool isPly(std::string_view bytes);

/// Reads the wanted properties of the element "vertex" as columns of the same names. The memory taken is proportional
/// to the number of bytes.
/// @param fileName  for messages
/// @throws InputError for what is no PLY file, for a vertex that is not all there, and for a wanted property that is
/// given twice or is a list
ParticleTable readPlyVertices(std::string_view bytes, const std::string& fileName,
                              std::span<const std::string_view> wanted);

}  // namespace scenes
