// Error estimate over several intervals. Beyond one interval errors shrink by damping or grow by collisions, so the
// step that meets the wanted error may differ from the step that an estimate over one interval gives. Called by the
// automatic stepper after it has compared its candidates.
#pragma once

#include "engine/error_control/error_estimate.h"

namespace engine {

/// Duration of the trial runs, s. Chosen: as long as an impact takes, and short enough that later collisions do not
/// multiply the errors of the impact.
inline constexpr double kLongEstimateSeconds = 0.2;

struct LongEstimate {
    double step = 0.0;   ///< step at which the error is the wanted error, as far as the trials show, s
    double spent = 0.0;  ///< force evaluations of all trials
    Trial trial;         ///< results of the last trial run
};

/// Finds the step at which a stepper's error over kLongEstimateSeconds, rounded up to whole intervals and at most
/// twelve, is the error that the setup asks for. The first trial runs with the given step; if the result is a much
/// different step, a second trial runs with that.
/// @param step      step that meets the wanted error over one interval, s
/// @param interval  length of an interval, s
/// @throws InstabilityError if a run becomes unstable
LongEstimate estimateLongError(const Simulation& simulation, StepperKind stepper, double step, double interval);

}  // namespace engine
