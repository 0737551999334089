// Velocity Verlet with swept contacts; called by takeStep.
#pragma once

#include "engine/simulation.h"

namespace engine {

/// Half kick, drift, half kick. The damping in the second kick needs a velocity that is not known yet: it is predicted
/// by letting the old force act for the whole step (lambda = 1 of Groot and Warren 1997), which keeps the order at 2
/// with one evaluation a step. The drag in the middle keeps the step symmetric.
void velocityVerletStep(Simulation& simulation, double h);

}  // namespace engine
