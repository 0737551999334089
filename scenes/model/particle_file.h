// Particle states as PLY files, which `globular simulate` writes, and a body with shape = "file" and `globular render
// --states` read. The functions here work on bytes; the program reads and writes the files.
//
// The header's comments say which moment of which scene it is: "frame 45", "time 1.5" in seconds and "simulation_hash
// 0123456789abcdef". One element "vertex", binary little-endian, in this order:
//   double x y z        m
//   double vx vy vz     m/s
//   double radius       m
//   double mass         kg
//   double birth_time   s, of the emission; 0 for the particles of bodies
//   uint   material                 index into the materials of the scene
//   uint   id                       order of emission
// A body does not take the times of birth: in a scene that starts from a file, all particles have age 0.
#pragma once

#include <optional>
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

/// Which moment of which scene a state of particles is.
struct StateStamp {
    int frame = 0;
    double time = 0.0;           ///< s
    std::string simulationHash;  ///< Scene::simulationHash

    friend bool operator==(const StateStamp&, const StateStamp&) = default;
};

/// The particles of a moment of a run, bit for bit.
struct ParticleState {
    engine::Particles particles;
    StateStamp stamp;
};

/// The bytes of a PLY file with position, velocity, radius, mass, time of birth, material and id of all particles.
/// @param stamp  what its comments say of the moment; without it they say nothing
std::string encodeParticles(const engine::Particles& particles, const std::optional<StateStamp>& stamp = std::nullopt);

/// Reads particles from the bytes of a PLY file, of this program or of another: as text or binary of either byte order,
/// with properties of any number type in any order. All but x, y and z may be left out, vx, vy and vz only together.
/// "pscale" and "psize" are other names of the radius. The memory taken is proportional to the number of bytes.
/// @throws InputError that names the file, the particle and what is wrong
ParticleFile decodeParticles(std::string_view bytes, const std::string& fileName);

/// Reads what encodeParticles() has written with a stamp. Properties are read as by decodeParticles(), but all of them
/// have to be there.
/// @throws InputError that names the file and what is wrong
ParticleState decodeState(std::string_view bytes, const std::string& fileName);

}  // namespace scenes
