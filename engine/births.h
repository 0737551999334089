// The births of a whole run at one moment: all emitters, one after another, each newborn in sight of everybody before
// it. Called once a step.
#pragma once

#include "engine/simulation.h"

namespace engine {

/// The births that are due at the simulation's time. Throws InstabilityError when one is out of the world.
void giveBirth(Simulation& simulation);

}  // namespace engine
