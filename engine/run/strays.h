// Counts particles that have left the scene for good, for example fallen off a table. They cost memory and time for as
// long as the run lasts unless the world is bounded; runs and `check` say so.
#pragma once

#include <cstdint>

#include "engine/state/simulation.h"

namespace engine {

/// Number of particles that have left the scene. The scene's place is the box around the initial particles, the sites
/// of emitters and the solid obstacles. A particle has left it if it is farther away than four times the diagonal of
/// the box, moves away from the box and does not rise against gravity, and touches no obstacle.
std::uint64_t strayCount(const Simulation& simulation);

}  // namespace engine
