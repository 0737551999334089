// Steps that are judged by the audit and may be rejected: how every stepper but the paper's gets to a point in time.
#pragma once

#include <limits>

#include "engine/state/simulation.h"

namespace engine {

/// Shortest step that is retried, s. Chosen: shorter than any motion within the world's limits needs.
inline constexpr double kShortestStep = 1e-12;

/// Brings the simulation to the given time (s) by its stepper in use. A step that the audit rejects is retried at half
/// the length; after a few accepted ones the length is doubled again.
/// @param longest          upper bound on the step, s
/// @param reason           what imposes this bound, for the report
/// @param mostEvaluations  force evaluations after which the run is given up
/// @return whether the simulation got to the time
/// @throws InstabilityError when even the shortest steps are rejected
bool advanceChecked(Simulation& simulation, double time, double longest, StepLimit reason,
                    double mostEvaluations = std::numeric_limits<double>::infinity());

}  // namespace engine
