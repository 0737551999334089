// Checks whether a run of a simulation's setup can have reached its state. Called for states that come from a file:
// neither array indices nor the number of steps may depend on damaged data.
#pragma once

#include "engine/state/simulation.h"

namespace engine {

/// Says what is impossible about the state of a simulation, for example "a particle is not in the world"; nullptr if
/// nothing is.
const char* stateError(const Simulation& simulation);

/// Whether all positions lie within kWorldLimit of the origin along every axis; a NaN does not.
bool isInWorld(const std::vector<Vec3>& positions);

}  // namespace engine
