// A simulation's state as bytes and back, so that a run can go on where another one ended, with the same bits. The
// caller reads and writes the files. Everything that the next step depends on is included, also the positions that the
// neighbor list was built for, because sums over pairs run in its order; scratch memory and the set-up are not.
#pragma once

#include <cstdint>
#include <span>
#include <stdexcept>
#include <vector>

#include "engine/state/simulation.h"

namespace engine {

/// The bytes are not those of a state of the simulation's set-up; what() says why.
class CheckpointError : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// The state as little-endian bytes; the last eight are a checksum of the others (FNV-1a). Some 130 bytes a particle.
std::vector<std::uint8_t> encodeCheckpoint(const Simulation& simulation);

/// The simulation of a set-up at an encoded state. The run goes on with the same bits as the one that was encoded.
/// @throws CheckpointError for bytes that are damaged, or of a set-up with other materials or emitters
Simulation decodeCheckpoint(const Setup& setup, std::span<const std::uint8_t> bytes);

}  // namespace engine
