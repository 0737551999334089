// The paper's stepper, symplectic Euler.
#pragma once

#include "engine/state/simulation.h"

namespace engine {

/// Takes one step of h seconds by equations 7 and 8: v += F/M dt, then x += v dt with the new velocity. The drag
/// multiplies v in between, as published. Returns whether all positions and velocities are valid afterwards (see
/// state_checks.h).
bool symplecticEulerStep(Simulation& simulation, double h);

}  // namespace engine
