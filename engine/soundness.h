// The check that a state is still one: called after births and after every move of the particles,
// before anything is computed from it.
#pragma once

#include "engine/simulation.h"

namespace engine {

/// Whether all positions are within the world and the squares of all speeds are numbers.
bool isSound(const Particles& particles);

/// Throws InstabilityError, naming the first particle that is not sound, or else the fastest one.
/// Shape:  h is the length of the step that could not be taken, s.
[[noreturn]] void reportInstability(const Simulation& simulation, double h);

/// Throws InstabilityError, naming the first particle whose position has left the world or whose speed is not finite.
/// Shape:  h is the step that led here, s.
void requireSound(const Simulation& simulation, double h);

}  // namespace engine
