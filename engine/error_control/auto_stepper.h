// The automatic stepper. Now and then it measures the error and the cost of each candidate on the next interval,
// estimates how the errors of the cheapest grow beyond it, and goes on with the cheapest one after that, at the step
// that just meets the wanted error. Called by advance().
#pragma once

#include "engine/state/simulation.h"

namespace engine {

/// Chosen: intervals from one error estimate to the next, at most. An estimate of the stepper in use costs two
/// intervals more than none, a comparison of all candidates some dozens, or a hundred where the errors of two of them
/// are followed. Estimates are close together at the start and spread out to this many intervals.
inline constexpr std::uint64_t kLongestPause = 16;

/// Simulations that an estimate holds at most beside the one it begins from: the finer run of each candidate, and the
/// one that runs.
inline constexpr std::size_t kRunsOfEstimate = 5;

/// Brings the simulation to the given time (s); one call is one interval, for example a frame. The choices depend on
/// the states alone, never on a clock.
void advanceAutomatically(Simulation& simulation, double time);

/// RMS over the mass of the acceleration that the implicit candidates' solver may leave out at the wanted error where
/// errors do not grow, m/s^2.
double acceptableResidual(const Simulation& simulation);

/// Whether a run can have led to this state of the automatic stepper with this candidate in use.
bool isReachable(const AutoState& state, StepperKind inUse);

}  // namespace engine
