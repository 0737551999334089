// The drift: half of what every stepper but the paper's does. Particles fly on with their velocities; obstacles take
// part in it (contact_drift.h).
#pragma once

#include "engine/simulation.h"

namespace engine {

/// Moves all particles for h seconds; velocities change where a particle meets an obstacle.
void drift(Simulation& simulation, double h);

/// What drag leaves of all velocities after h seconds; nothing happens without drag.
void applyDrag(Simulation& simulation, double h);

}  // namespace engine
