// Particle states as files: what `globular simulate` writes by default, and what a body with shape = "file" reads, in
// any of the formats of formats.h and of other programs. The functions here work on bytes; the program reads and writes
// the files.
//
// By default `globular simulate` writes PLY. One element "vertex", binary little-endian, in this order:
//   double x y z        m
//   double vx vy vz     m/s
//   double radius       m
//   double mass         kg
//   double birth_time   s, of the emission; 0 for the particles of bodies
//   uint   material                 index into the materials of the scene
//   uint   id                       order of emission
//   double enthalpy     J, 0 at 0 K; only in scenes that have heat
// A body does not take the times of birth: in a scene that starts from a file, all particles have age 0.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/state/particles.h"
#include "scenes/particles/particle_frame.h"

namespace scenes {

/// The contents of a particle file. Properties that the file leaves out are zero for all particles. Ids are always 0,
/// 1, 2, ...
struct ParticleFile {
    engine::Particles particles;
    bool hasRadius = false;
    bool hasMass = false;
    bool hasMaterial = false;
    /// Names of what the particles are made of, in files that have no numbers of materials, and for each particle an
    /// index into them. Both are empty for files without.
    std::vector<std::string> speciesNames;
    std::vector<std::uint32_t> species;
    std::vector<double> temperature;   ///< K, of any value; empty if the file has none
    std::vector<std::string> skipped;  ///< what else the file has: names of properties and elements
};

/// The particles of a moment of a run, bit for bit.
struct ParticleState {
    engine::Particles particles;
    StateStamp stamp;
};

/// The bytes of a PLY file with position, velocity, radius, mass, time of birth, material and id of all particles.
/// @param stamp  what its comments say of the moment; without it they say nothing
std::string encodeParticles(const engine::Particles& particles, const std::optional<StateStamp>& stamp = std::nullopt);

/// Reads particles from the bytes of a file of this program or of another, whose content tells its format: PLY, VTK
/// PolyData, extended XYZ or a LAMMPS dump. All but positions may be left out; velocities are given whole or not at
/// all. "pscale" and "psize" are other names of the radius in PLY files. Of a file with several snapshots the last is
/// read. The memory taken is proportional to the number of bytes.
/// @throws InputError that names the file, the particle or the line, and what is wrong
ParticleFile decodeParticles(std::string_view bytes, const std::string& fileName);

/// Reads what encodeParticles() has written with a stamp. Properties are read as by decodeParticles(), but all of them
/// have to be there.
/// @throws InputError that names the file and what is wrong
ParticleState decodeState(std::string_view bytes, const std::string& fileName);

}  // namespace scenes
