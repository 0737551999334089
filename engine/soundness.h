// The check that a state is still one: called after every move of the particles, before anything is computed from it.
#pragma once

#include "engine/simulation.h"

namespace engine {

/// Throws InstabilityError, naming the first particle whose position has left the world or whose speed is not finite.
/// Shape:  h is the step that led here, s.
void requireSound(const Simulation& simulation, double h);

}  // namespace engine
