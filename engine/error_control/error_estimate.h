// Estimates the error of a run by step doubling: the same interval is run with a step and with half that step. Called
// for runs with a fixed step (error_samples.h); the automatic stepper has estimates of its own (step_control.h).
#pragma once

#include <limits>

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
    double mostEvaluations = std::numeric_limits<double>::infinity();  ///< most force evaluations of the first run
    double mostOfFiner = std::numeric_limits<double>::infinity();      ///< most force evaluations of the second run
};

/// Results of the two runs of an error estimate.
struct Trial {
    bool finished = true;  ///< whether both runs got to the end; else only `spent` is of use
    double step = 0.0;     ///< mean step of the first run, s
    double error = 0.0;    ///< error at the mean step, radii per second of motion
    double spent = 0.0;    ///< force evaluations of both runs together
};

/// Measures the error of a stepper from the present state to a given time. The interval is run with steps h and then
/// with steps h' of half the length. With the differences dx and dv of positions and velocities at the end, and the
/// horizon T = kErrorHorizon, the error is the RMS over the particles of dx + T dv, in radii, divided by the interval
/// and, by Richardson's argument for a stepper of order p, by 1 - (h'/h)^p.
/// @throws InstabilityError if one of the runs becomes unstable
Trial measure(const Simulation& simulation, const TrialRun& trialRun);

}  // namespace engine
