// The fields of a scene in a time step. A step of any stepper stands between two halves of the fields' kick (Strang
// splitting), which keeps steppers of second order at second order: fields act on the velocities at rest positions, and
// exactly so for drag. Called by take_step.cpp and the paper's stepper. Does nothing in a scene without fields.
#pragma once

#include "engine/state/simulation.h"

namespace engine {

/// Changes the velocities by the fields' action over the first half of a step of h seconds from the simulation's time.
/// The energy that the particles gain is added to the step cache's work.
void kickBefore(Simulation& simulation, double h);

/// The same over the second half. Where the stepper knows the energy at the end of the step, the gain is added to that
/// energy, too, and the difference of the two halves to the error of its prediction.
void kickAfter(Simulation& simulation, double h);

}  // namespace engine
