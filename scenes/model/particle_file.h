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

#include "engine/state/particles.h"

namespace scenes {

/// The contents of a particle file. Arrays that the file leaves out hold zeros. Ids are always 0, 1, 2, ...
struct ParticleFile {
    engine::Particles particles;
    bool hasRadius = false;
    bool hasMass = false;
    bool hasMaterial = false;
};

/// The bytes of a particle file with all properties above.
std::string encodeParticles(const engine::Particles& particles);

/// The particles in the bytes of a file. Properties may come in any order, as float or double; all but x, y and z may
/// be left out, velocities only together. The memory taken is proportional to the number of bytes.
/// @throws InputError that names the file, the particle and what is wrong
ParticleFile decodeParticles(std::string_view bytes, const std::string& fileName);

}  // namespace scenes
