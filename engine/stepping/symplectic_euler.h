// The paper's stepper, symplectic Euler, and a loop of equal steps of it to a point in time. No step is audited. Called
// by advance(), and by the error estimate.
#pragma once

#include "engine/state/simulation.h"

namespace engine {

/// Takes one step of h seconds by equations 7 and 8: v += F/M dt, then x += v dt with the new velocity. The drag
/// multiplies v in between, as published. Returns whether all positions and velocities are valid afterwards (see
/// state_checks.h).
bool symplecticEulerStep(Simulation& simulation, double h);

/// Advances the simulation to the given time (s) by equal steps of the paper's stepper that are no longer than the
/// setup's step. No step is audited or taken back.
/// @throws InstabilityError if a position or velocity becomes infinite, NaN or too large for the engine
void advanceInEqualSteps(Simulation& simulation, double time);

}  // namespace engine
