// Whether a simulation is in a state that a run of its set-up can have left. Called where a state comes from outside:
// what the engine indexes by, or how many steps it takes, must not be up to a file.
#pragma once

#include "engine/state/simulation.h"

namespace engine {

/// What is impossible about the state, as in "a particle is not in the world"; nullptr where nothing is.
const char* flawOf(const Simulation& simulation);

/// Whether all of it lies in the world; a NaN does not.
bool isInWorld(const std::vector<Vec3>& positions);

}  // namespace engine
