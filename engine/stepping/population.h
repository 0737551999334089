// How particles enter and leave a run. Emitters add particles once a step. Particles outside the world are removed
// between frames only, so that no particle disappears between a step and the check of that step.
#pragma once

#include "engine/state/simulation.h"

namespace engine {

/// Time at which the next emission of any emitter is due or tried again, s; infinity if there will be none.
double nextEmission(const Simulation& simulation);

/// Appends the particles that emitters have due at or before the simulation's time, where there is room for them. A
/// particle that was due earlier starts where free flight under gravity would have taken it by now.
/// @throws InstabilityError when the position or velocity of a new particle is outside what the engine can represent
void emitDue(Simulation& simulation);

/// Removes the particles that are outside the bounds of the world, if it has any; the other particles keep their order
/// and ids. Takes time linear in the number of particles.
void removeOutOfBounds(Simulation& simulation);

}  // namespace engine
