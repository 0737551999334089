// Particle states as PLY files, which `globular simulate` writes and a body with shape = "file" reads. The functions
// here work on bytes; the program reads and writes the files.
//
// One element "vertex", binary little-endian, in this order:
//   double x y z        m
//   double vx vy vz     m/s
//   double radius       m
//   double mass         kg
//   uint   material                 index into the materials of the scene
//   uint   id                       order of emission
// The emission times are not stored: in a scene that starts from a file, particles have age 0.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "engine/state/particles.h"

namespace scenes {

/// The contents of a particle file. Properties that the file leaves out are zero for all particles. Ids are always 0,
/// 1, 2, ...
struct ParticleFile {
    engine::Particles particles;
    bool hasRadius = false;
    bool hasMass = false;
    bool hasMaterial = false;
    std::vector<std::string> skipped;  ///< what else the file has: names of properties and elements
};

/// The bytes of a PLY file with position, velocity, radius, mass, material and id of all particles.
std::string encodeParticles(const engine::Particles& particles);

/// Reads particles from the bytes of a PLY file, of this program or of another: as text or binary of either byte order,
/// with properties of any number type in any order. All but x, y and z may be left out, vx, vy and vz only together.
/// "pscale" and "psize" are other names of the radius. The memory taken is proportional to the number of bytes.
/// @throws InputError that names the file, the particle and what is wrong
ParticleFile decodeParticles(std::string_view bytes, const std::string& fileName);

}  // namespace scenes
