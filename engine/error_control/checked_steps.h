// Steps that may be taken back: what advance() does for every stepper but the paper's.
#pragma once

#include <limits>

#include "engine/state/simulation.h"

namespace engine {

/// Chosen: shorter than anything that a motion within the world's limits asks for, s. No shorter step is retried.
inline constexpr double kShortestStep = 1e-12;

/// Brings the simulation to the given time (s) by its stepper in use, in steps no longer than `longest` (s), which
/// `why` is the reason for. A step that the audit objects to is retried at half the length; after a few good ones the
/// length is doubled again. Returns whether it got there: not if it took more than `mostEvaluations` over all pairs.
/// Throws: InstabilityError when even the shortest steps do not pass.
bool advanceChecked(Simulation& simulation, double time, double longest, StepLimit why,
                    double mostEvaluations = std::numeric_limits<double>::infinity());

}  // namespace engine
