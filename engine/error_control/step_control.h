// Estimates the error of every step from the step itself, without a force evaluation, and controls the length of the
// next one. Used by the automatic stepper through checked_steps.h.
#pragma once

#include <optional>

#include "engine/state/simulation.h"
#include "engine/stepping/step_audit.h"

namespace engine {

/// Estimate of the position error that the step of h seconds from the saved state has made, in radii per second of
/// motion, but for a factor that depends on the motion, the calibration of StepControl. Nothing where there is no
/// estimate: without particles, and for an implicit step without one before it. To be called once for every step that
/// the audit accepts.
///
/// - Velocity Verlet, and leapfrog without the part of gravity: rms(|v - v_p| / r) / 3, where v is the velocity at the
/// end of the step and v_p the one that was
///   predicted for its damping. Without damping v - v_p = h/2 (a_1 - a_0), so that this is the local error of the
///   positions, h^3/6 times the slope of the acceleration, over h.
/// - Implicit steppers: the same with the slope of the mean accelerations of this step and the one before.
std::optional<double> estimateStep(Simulation& simulation, const SavedState& before, double h);

/// Sets the length of the next step by a digital filter of the errors of the last two, H211b with b = 4 (G. Soederlind,
/// Digital filters in adaptive time-stepping, 2003). Only square roots are taken, so that the bits do not depend on a
/// library. A step that frames or emissions have ended early counts as if it had had the length that was wanted.
/// @param h         length of the step, s
/// @param estimate  of its error, radii per second of motion, without calibration
/// @param wanted    error that is wanted, radii per second of motion
void control(StepControl& steps, StepperKind stepper, double h, double estimate, double wanted);

/// Corrects the calibration of a stepper by a measured error and the mean estimate of the same steps, both in radii per
/// second of motion. What comes next may err more for the same estimate, for example an impact after a fall, and less
/// is believed only by and by.
void calibrate(StepControl& steps, double error, double estimate);

/// The control of a stepper.
inline StepControl& controlOf(Simulation& simulation, StepperKind stepper) {
    return simulation.automatic.controls[static_cast<std::size_t>(stepper)];
}

/// Whether the numbers of a control are possible values; NaNs are not. Checked for those that come from a file.
bool isPossible(const StepControl& steps);

/// Whether the error of a step is so far above the wanted one that the step is taken back.
bool isRefused(const StepControl& steps, double estimate, double wanted);

}  // namespace engine
