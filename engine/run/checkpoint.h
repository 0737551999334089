// A simulation's state as bytes and back, so that a run can go on where another one ended, with the same bits. The
// caller reads and writes the files. Everything that the next step depends on is included, even the positions from
// which the neighbor list was built, because the order of the list determines the order of sums over pairs. Scratch
// memory and the setup are not included.
#pragma once

#include <cstdint>
#include <span>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "engine/state/simulation.h"

namespace engine {

/// How a checkpoint of any version begins, in ASCII.
inline constexpr std::string_view kCheckpointMark = "GLBLCKP";

/// Thrown if the bytes of a checkpoint are not those of a state of the given setup; what() gives the reason.
class CheckpointError : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Encodes the state of a simulation as little-endian bytes, about 130 a particle. The last eight bytes are a checksum
/// (FNV-1a) of the bytes before.
std::vector<std::uint8_t> encodeCheckpoint(const Simulation& simulation);

/// What a neighbor list was built for.
struct ListOrigin {
    std::vector<Vec3> builtAt;  ///< positions of the first particles, m
    double cutoff = 0.0;        ///< m
    double skin = 0.0;          ///< m
};

/// The same with a neighbor list that the simulation does not have.
std::vector<std::uint8_t> encodeCheckpoint(const Simulation& simulation, const ListOrigin& list);

/// Restores a simulation from its setup and an encoded state. The run continues with the same bits as the encoded run.
/// @throws CheckpointError if the bytes are damaged or belong to a setup with other materials or emitters
Simulation decodeCheckpoint(const Setup& setup, std::span<const std::uint8_t> bytes);

/// The part of a simulation that is not of its particles: the same on all ranks.
std::vector<std::uint8_t> encodeCommon(const Simulation& simulation);
void decodeCommon(std::span<const std::uint8_t> bytes, Simulation& simulation);

}  // namespace engine
