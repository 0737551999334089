// The paper's stepper, and its way to a point in time: equal steps, none of which is judged. Called by advance(), and
// by the error estimate to measure the paper's stepper.
#pragma once

#include "engine/state/simulation.h"

namespace engine {

/// One step of h seconds. Equations 7 and 8: v += F/M dt, then x += v dt with the new velocity. The drag multiplies v
/// in between, as published. Returns whether all particles are valid after it (state_checks.h).
bool symplecticEulerStep(Simulation& simulation, double h);

/// Brings the simulation to the given time (s) by equal steps of the paper's stepper, no longer than the set-up's. No
/// step is judged or taken back.
/// @throws InstabilityError when a particle is no longer finite or has left what the engine can represent.
void advanceInEqualSteps(Simulation& simulation, double time);

}  // namespace engine
