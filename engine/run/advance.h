// The public interface of the engine: starts a simulation and advances it to a point in time. Callers name a time,
// which is reached exactly; error_control/ decides which steps lead there.
#pragma once

#include "engine/state/simulation.h"

namespace engine {

/// Returns a simulation at time zero, which includes the particles that emitters emit at that time.
/// @param ranks  the processes that share its particles; each keeps those that it is the owner of
Simulation start(const Setup& setup, const Ranks& ranks = Ranks::alone());

/// Advances the simulation to the given time (s), which is reached exactly. The paper's stepper takes equal steps that
/// are no longer than the setup's step; with all other steppers, steps that gain energy or move a particle too far
/// (step_audit.h) are taken back and retried. Particles that are outside the bounds of the world are removed before the
/// first step.
/// @throws InstabilityError if a position or velocity becomes infinite, NaN or too large for the engine
/// @throws Stopped if Simulation::beforeStep does
void advance(Simulation& simulation, double time);

}  // namespace engine
