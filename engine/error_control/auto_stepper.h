// The automatic stepper. It controls the length of the steps by the error that each of them shows, corrects what they
// show by comparing the run with a trial run, its twin, now and then, and takes another stepper where that costs less.
// Called by advance().
#pragma once

#include "engine/state/simulation.h"

namespace engine {

/// Longest pause from the start of a twin to that of the next, in durations of a twin. Chosen by cost: the steps of a
/// twin are 1.5 times as long as those of the run.
inline constexpr std::uint64_t kLongestPause = 6;

/// Largest number of copies of the simulation that exist beside it.
inline constexpr std::size_t kTrialRuns = 1;

/// Advances the simulation to the given time (s) by one interval, for example a frame, with the automatic stepper. Its
/// choices depend only on the states, never on a clock.
void advanceAutomatically(Simulation& simulation, double time);

/// Tolerance of the implicit steppers' solver for the wanted error, as the mass-weighted RMS of the acceleration that
/// the solver may leave out, m/s^2.
double acceptableResidual(const Simulation& simulation);

/// Whether a run can have led to this state of the automatic stepper and to this stepper in use. Checked for states
/// that come from a file.
bool isReachable(const AutoState& state, StepperKind inUse);

}  // namespace engine
