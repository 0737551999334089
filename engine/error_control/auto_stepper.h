// The automatic stepper: now and then it measures on the next interval what each candidate errs and costs, looks ahead
// at what becomes of the errors of the cheapest, and goes on with the one that is the cheapest then, at the step that
// just meets the wanted error. Called by advance().
#pragma once

#include "engine/state/simulation.h"

namespace engine {

/// Chosen: a look costs two intervals more than none, a comparison of all candidates some dozens, or a hundred where
/// two of them are followed. Looks are close together at the start and spread out to every so many intervals.
inline constexpr std::uint64_t kLongestPause = 16;

/// Simulations that a look holds at most beside the one it begins from: one of each candidate, to go on from, and the
/// one that runs.
inline constexpr std::size_t kRunsOfLook = 5;

/// Brings the simulation to the given time (s); one call is one interval, e.g. a frame.
/// Holds:  what it chooses depends on the states alone, never on a clock.
void advanceAutomatically(Simulation& simulation, double time);

/// rms over the mass of the acceleration that the implicit candidates' solver may leave out at the wanted error, where
/// errors do not grow, m/s^2.
double acceptableResidual(const Simulation& simulation);

/// Whether looks can have led to what the stepper knows, and to the candidate that is in use.
bool isReachable(const AutoState& state, StepperKind inUse);

}  // namespace engine
