// Whether a simulation is in a state that a run of its set-up can have reached. Called where a state comes from
// outside: what the engine indexes by, and how many steps it takes, must not depend on a damaged file.
#pragma once

#include "engine/state/simulation.h"

namespace engine {

/// What is impossible about the state, for example "a particle is not in the world"; nullptr if nothing is.
const char* stateError(const Simulation& simulation);

/// Whether all positions lie in the world; a NaN does not.
bool isInWorld(const std::vector<Vec3>& positions);

}  // namespace engine
