// How errors develop beyond one interval, by damping or by collisions: finds the step that meets the wanted error where
// an estimate over one interval would miss it. Called by the automatic stepper when it has compared its candidates.
#pragma once

#include "engine/error_control/error_estimate.h"

namespace engine {

/// Length of the trials, s. Chosen: as long as an impact takes, and short enough that collisions after it do not
/// multiply its errors.
inline constexpr double kLongEstimateSeconds = 0.2;

struct LongEstimate {
    double step = 0.0;   ///< at which the error is the wanted one, as far as the trials show, s
    double spent = 0.0;  ///< force evaluations
    Trial trial;         ///< the last one; over many intervals its cost is seldom that of a single event
};

/// Finds the step at which a stepper's error over kLongEstimateSeconds, in whole intervals (s) and at most twelve, is
/// the set-up's. Begins at the step (s), at most one interval, that meets the error over one interval; a much different
/// step gets a trial, too.
/// @throws InstabilityError
LongEstimate estimateLongError(const Simulation& simulation, StepperKind stepper, double step, double interval);

}  // namespace engine
