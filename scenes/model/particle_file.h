// Particle states as PLY files: what `globular simulate` writes and what a body with shape = "file" reads. No file is
// written here; the program writes the bytes.
//
// One element "vertex", binary little-endian, in this order:
//   double x y z        m
//   double vx vy vz     m/s
//   double radius       m
//   double mass         kg          so that the state can be used again exactly
//   uint   material                 index into the materials of the scene
//   uint   id                       order of birth
// Times of birth are not kept: a scene that starts from a file starts at age 0.
#pragma once

#include <string>
#include <string_view>

#include "engine/state/particles.h"

namespace scenes {

/// What a particle file holds. Arrays that it leaves out have zeros here, except ids, which are 0, 1, 2, ... always.
struct ParticleFile {
    engine::Particles particles;
    bool hasVelocity = false;
    bool hasRadius = false;
    bool hasMass = false;
    bool hasMaterial = false;
};

/// The bytes of a particle file with all properties above.
std::string encodeParticles(const engine::Particles& particles);

/// The particles in the bytes of a file. Properties may come in any order, as float or double; all but x, y and z may
/// be left out, velocities only together. Throws: InputError that names the file and what is wrong with it. Memory
/// stays in proportion to the bytes given.
ParticleFile decodeParticles(std::string_view bytes, const std::string& fileName);

}  // namespace scenes
