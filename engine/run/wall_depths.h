// How deep particles lie in obstacles.
#pragma once

#include "engine/state/simulation.h"

namespace engine {

/// Brings the record of a simulation's penetration depths up to date with its present state.
void recordWallDepths(Simulation& simulation);

}  // namespace engine
