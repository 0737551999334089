// What becomes of an error after a while, by damping or by collisions: the step that meets the wanted error where a
// look at one interval would not see it. Called by the automatic stepper when it has compared its candidates.
#pragma once

#include "engine/error_control/error_estimate.h"

namespace engine {

/// Chosen: as long as an impact takes, short enough that collisions after it do not multiply its errors, s.
inline constexpr double kFarSeconds = 0.2;

struct FarLook {
    double step = 0.0;   ///< at which the error is the wanted one, as far as could be seen, s
    double spent = 0.0;  ///< passes over all pairs
    Trial trial;         ///< the last measurement: over many intervals, what steps cost is seldom one event's
};

/// Looks for the step at which a stepper's error over kFarSeconds, in whole intervals (s) and no more than twelve, is
/// the set-up's. It begins at the step (s) that meets the error over one interval, at most one interval; a much
/// different one is looked at too.
/// Throws: InstabilityError.
FarLook lookFar(const Simulation& simulation, StepperKind stepper, double step, double interval);

}  // namespace engine
