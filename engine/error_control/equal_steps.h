// The loop of equal steps of the paper's stepper to a point in time, none of which is audited.
#pragma once

#include "engine/state/simulation.h"

namespace engine {

/// Advances the simulation to the given time (s) by equal steps of the paper's stepper that are no longer than the
/// setup's step. No step is audited or taken back.
/// @throws InstabilityError if a position or velocity becomes infinite, NaN or too large for the engine
void advanceInEqualSteps(Simulation& simulation, double time);

}  // namespace engine
