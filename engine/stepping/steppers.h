// The steppers: each takes a simulation one step further. Called by advance() and by the error estimate; births and
// checks are the caller's.
#pragma once

#include <array>
#include <string_view>

#include "engine/state/simulation.h"

namespace engine {

/// Moves particles by one step of the simulation's stepper, h in seconds; its time is the caller's.
void takeStep(Simulation& simulation, double h);

/// All of them, the automatic one last.
inline constexpr std::array kSteppers = {StepperKind::symplecticEuler,  StepperKind::velocityVerlet,
                                         StepperKind::leapfrog,         StepperKind::implicitDamping,
                                         StepperKind::linearlyImplicit, StepperKind::automatic};

/// "symplectic-euler", "velocity-verlet", "leapfrog", "implicit-damping", "linearly-implicit", "auto": the name in
/// scene files and reports.
std::string_view nameOf(StepperKind stepper);

/// "given step", "wanted error", "energy audit" and so on: what limited a step, in reports.
std::string_view nameOf(StepLimit limit);

/// Order of convergence of the positions, where there is damping.
int orderOf(StepperKind stepper);

/// What steps of this share of their length make of the error, and what share of the length makes so much of the error.
double errorShare(StepperKind stepper, double ofLength);
double stepShare(StepperKind stepper, double ofError);

}  // namespace engine
