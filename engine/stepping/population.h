// How particles enter and leave a run: births at all emitters, once a step, and the removal of those beyond the bounds
// of the world, between intervals, so that no step and no verdict on one sees a particle disappear.
#pragma once

#include "engine/stepping/simulation.h"

namespace engine {

/// The births that are due at the simulation's time. Throws InstabilityError when one is out of the world.
void giveBirth(Simulation& simulation);

/// Removes the particles that are beyond the bounds of the world, if it has any; the others keep their order and ids.
/// Takes time linear in the number of particles.
void removeLeavers(Simulation& simulation);

}  // namespace engine
