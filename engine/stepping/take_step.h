// Takes a time step with any of the steppers, and lists their names and orders of convergence. The caller emits
// particles and checks the result of a step.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "engine/state/simulation.h"

namespace engine {

/// Moves the particles by one step of h seconds with the stepper that the simulation has in use. The caller advances
/// the simulation's time.
void takeStep(Simulation& simulation, double h);

// A step of any stepper stands between two halves of the fields' kick (Strang splitting), which keeps steppers of
// second order at second order: meanwhile particles stay where they are, and drag decays exactly. takeStep() does this;
// the functions below are for the loop of the paper's stepper. They do nothing in a scene without fields.

/// Changes the velocities by the fields' action over the first half of a step of h seconds from the simulation's time.
/// The energy that the particles gain is added to the step cache's work.
void kickBefore(Simulation& simulation, double h);

/// The same over the second half. Where the stepper knows the energy at the end of the step, the gain is added to that
/// energy, too, and the difference of the two halves to the error of its prediction.
void kickAfter(Simulation& simulation, double h);

/// The smallest number of equal steps, at least one, that last a duration (s) and are each no longer than a bound (s).
/// The slack keeps 0.02 s at steps of 0.01 s from becoming three.
inline double stepCount(double duration, double longest) {
    return std::max(1.0, std::ceil(duration / longest * (1.0 - 1e-9)));
}

/// All steppers, the automatic one last.
inline constexpr std::array kSteppers = {StepperKind::symplecticEuler,  StepperKind::velocityVerlet,
                                         StepperKind::leapfrog,         StepperKind::implicitDamping,
                                         StepperKind::linearlyImplicit, StepperKind::automatic};

/// Name of a stepper in scene files and reports: "symplectic-euler", "velocity-verlet", "leapfrog", "implicit-damping",
/// "linearly-implicit" or "auto".
std::string_view nameOf(StepperKind stepper);

/// Name in reports of what limited the length of a step: "given step", "wanted error", "energy audit" and so on.
std::string_view nameOf(StepLimit limit);

/// Order of convergence of a stepper's positions in a motion with damping: 1 or 2.
int orderOf(StepperKind stepper);

/// Factor by which a stepper's error changes if the step changes by a factor: that factor to the power of the order.
double errorRatio(StepperKind stepper, double stepRatio);

/// Factor by which the step must change for the error to change by a factor; the inverse function of errorRatio().
double stepRatio(StepperKind stepper, double errorRatio);

}  // namespace engine
