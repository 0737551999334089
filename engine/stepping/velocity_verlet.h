// Velocity Verlet with swept contacts. Called by takeStep().
#pragma once

#include "engine/state/simulation.h"

namespace engine {

/// Lambda of Groot and Warren 1997: the share of the step for which the old force acts on the velocity that damping is
/// computed from. 1 keeps the order at 2. With 1/2 damping sees the velocity at the middle of the step: the scheme is
/// then stable at twice the step where damping limits it, as the paper's stepper is, and of order 1 where there is
/// damping.
inline constexpr double kWholeStep = 1.0;
inline constexpr double kHalfStep = 0.5;

/// Takes one step of h seconds: half a kick, a drift, half a kick, with one force evaluation. The damping in the second
/// kick needs a velocity that is not known yet, and gets a predicted one. The drag acts in the middle, which keeps the
/// step symmetric.
void velocityVerletStep(Simulation& simulation, double h, double lambda);

}  // namespace engine
