// The door to the engine: how a simulation starts, and how it gets to a point in time. Callers ask for a time and get
// there exactly; which steps lead there is decided in error_control/.
#pragma once

#include "engine/state/simulation.h"

namespace engine {

/// A simulation at time zero, with the particles that emitters have due then.
Simulation start(const Setup& setup);

/// Brings the simulation to the given time (s), which is hit exactly. The paper's stepper takes equal steps no longer
/// than the set-up's; the others also take back and retry what the audit does not let pass. Particles that are outside
/// the bounds of the world now are removed before the first step.
/// @throws InstabilityError when a particle is no longer finite or has left what the engine can represent.
void advance(Simulation& simulation, double time);

}  // namespace engine
