// How far off a step is, measured instead of promised: the same state is taken one step and two half steps further.
// Called by the render loop on a few frames; the simulation itself does not notice.
#pragma once

#include "engine/simulation.h"

namespace engine {

/// Local position error of one step of h seconds at the current state.
/// Shape:  rms over the particles, in radii per second of motion; 0 without particles.
/// Source: Richardson: with order p, one step errs by the difference to two half steps divided by 1 - 2^-p.
double localError(const Simulation& simulation, double h);

}  // namespace engine
