// Advances a simulation by steps that are audited (see stepping/step_audit.h) and may be rejected. Used with every
// stepper except the paper's.
#pragma once

#include <limits>

#include "engine/state/simulation.h"

namespace engine {

/// A rejected step that is shorter than this is not retried, s. Chosen: shorter than any motion within the world's
/// limits needs.
inline constexpr double kShortestStep = 1e-12;

/// Lets the automatic stepper choose the steps, by their errors.
struct ErrorControl {
    StepControl steps;      ///< changes with every step
    double wanted = 0.0;    ///< wanted error, radii per second of motion
    double estimate = 0.0;  ///< integral over time of the estimates of the steps, without calibration, radii
};

/// Advances the simulation to the given time (s) with its stepper in use. A step that gains energy or moves a particle
/// too far (step_audit.h) is retried at half the length; after a few accepted steps the length is doubled again.
/// @param longest          upper bound on the step, s
/// @param reason           the reason for this bound, for the report
/// @param mostEvaluations  number of force evaluations after which the function gives up
/// @param errors           if given, chooses steps that are no longer than `longest`
/// @return whether the simulation has reached the given time
/// @throws InstabilityError when even the shortest steps are rejected
bool advanceChecked(Simulation& simulation, double time, double longest, StepLimit reason,
                    double mostEvaluations = std::numeric_limits<double>::infinity(), ErrorControl* errors = nullptr);

}  // namespace engine
