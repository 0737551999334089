// The automatic stepper: now and then it measures on the next interval what each candidate errs and costs, and goes on
// with the cheapest one, at the step that just meets the wanted error. Called by advance().
#pragma once

#include "engine/simulation.h"

namespace engine {

/// Brings the simulation to the given time (s); one call is one interval, e.g. a frame.
/// Holds:  what it chooses depends on the states alone, never on a clock.
void advanceAutomatically(Simulation& simulation, double time);

}  // namespace engine
