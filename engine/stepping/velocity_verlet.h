// Velocity Verlet with swept contacts; called by takeStep.
#pragma once

#include "engine/state/simulation.h"

namespace engine {

/// Lambda of Groot and Warren 1997: for what share of the step the old force acts on the velocity that damping is
/// computed from. 1 keeps the order at 2; 1/2 has the velocity of the middle, bears twice the step where damping limits
/// it, as the paper's stepper does, and is of order 1 where there is damping.
inline constexpr double kWholeStep = 1.0;
inline constexpr double kHalfStep = 0.5;

/// Half kick, drift, half kick, with one evaluation a step. The damping in the second kick needs a velocity that is not
/// known yet: it is predicted. The drag in the middle keeps the step symmetric.
void velocityVerletStep(Simulation& simulation, double h, double lambda);

}  // namespace engine
