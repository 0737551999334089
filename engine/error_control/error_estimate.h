// Estimates the error of a run by step doubling: the same interval is run with a step and with half that step. Called
// by the automatic stepper to choose steps, and by the loops over frames to report errors.
#pragma once

#include <limits>
#include <optional>

#include "engine/state/simulation.h"

namespace engine {

/// Error horizon: time for which an error in a velocity displaces a particle, until damping or a collision removes it,
/// s. Measured: with it the estimate is within a factor of two of the error against a reference on liquid, solid,
/// fountain and honey (`globular study accuracy`).
inline constexpr double kErrorHorizon = 0.0125;

/// The runs of an error estimate: stepper, step and end.
struct TrialRun {
    double time = 0.0;  ///< time at which the runs end, s
    StepperKind stepper = StepperKind::velocityVerlet;
    double step = 0.0;                                                 ///< longest step of the first run, s
    double horizon = kErrorHorizon;                                    ///< error horizon for velocities, s
    double mostEvaluations = std::numeric_limits<double>::infinity();  ///< most force evaluations of the first run
    double mostOfFiner = std::numeric_limits<double>::infinity();      ///< most force evaluations of the second run
};

/// Results of the two runs of an error estimate.
struct Trial {
    StepperKind stepper = StepperKind::velocityVerlet;
    bool finished = true;  ///< whether both runs got to the end; else only `spent` is of use
    double asked = 0.0;    ///< longest step that the first run was allowed to take, s
    double step = 0.0;     ///< mean step of the first run, s
    double error = 0.0;    ///< error at the mean step, radii per second of motion
    double cost = 0.0;     ///< cost at the mean step, force evaluations per second
    double spent = 0.0;    ///< force evaluations of both runs together
    /// Reason of the last rejection, if steps of the first run were rejected (step_audit.h) or restricted.
    std::optional<StepLimit> restriction;
};

/// Measures error and cost of a stepper from the present state to a given time. The interval is run with steps h and
/// then with steps h' of half the length. With the differences dx and dv of positions and velocities at the end, and
/// the horizon T, the error is the RMS over the particles of dx + T dv, in radii, divided by the interval and, by
/// Richardson's argument for a stepper of order p, by 1 - (h'/h)^p.
/// @param finer  if given, receives the simulation at the end of the run with the shorter steps
/// @throws InstabilityError if one of the runs becomes unstable
Trial measure(const Simulation& simulation, const TrialRun& trialRun, Simulation* finer = nullptr);

/// Shorter steps are wasted if the error stays above this share. With steps 1.5 times shorter, a method of second order
/// should have an error 2.2 times smaller; otherwise the error has another cause, for example a swept contact.
inline constexpr double kWasted = 0.7;

/// The step (s) at which the error would be the wanted error (radii per second), within the range to which a
/// measurement can be extrapolated.
double wantedStep(const Trial& trial, double wanted);

/// Ratio of a step (s) to the step at which the trial was measured.
double stepRatioTo(const Trial& trial, double step);

/// Predicted cost of a run with steps no longer than `step` (s), in force evaluations per second of motion. Emissions
/// are assumed to cut short the same number of steps at any step length.
double costAt(const Trial& trial, double step);

}  // namespace engine
