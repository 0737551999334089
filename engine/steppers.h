// The steppers: each takes a simulation one step further. Called by advance() and by the error estimate; births and
// checks are the caller's.
#pragma once

#include <string_view>

#include "engine/simulation.h"

namespace engine {

/// Moves particles, velocities and time by one step of the set-up's stepper, h in seconds.
void takeStep(Simulation& simulation, double h);

/// "symplectic-euler", "velocity-verlet": the name in scene files and reports.
std::string_view nameOf(StepperKind stepper);

/// Order of convergence of the positions.
int orderOf(StepperKind stepper);

}  // namespace engine
