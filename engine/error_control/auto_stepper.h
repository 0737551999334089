// The automatic stepper. From time to time it measures the error and the cost of each candidate stepper over the next
// interval, and estimates how the errors of the cheapest candidates grow beyond the interval. It then continues with
// the candidate that costs least at a step that just meets the wanted error. Called by advance().
#pragma once

#include "engine/state/simulation.h"

namespace engine {

/// Largest number of intervals from one error estimate to the next; at the start of a run estimates are closer
/// together. Chosen by cost: to estimate the error of the stepper in use costs as much as two intervals, and to compare
/// all candidates as much as some dozens, or a hundred if the error growth of two candidates is measured.
inline constexpr std::uint64_t kLongestPause = 16;

/// Largest number of copies of the simulation that an error estimate holds in memory at the same time: one finer run
/// for each candidate, and the run in progress.
inline constexpr std::size_t kRunsOfEstimate = 5;

/// Advances the simulation to the given time (s) by one interval, for example a frame, with the automatic stepper. Its
/// choices depend only on the states, never on a clock.
void advanceAutomatically(Simulation& simulation, double time);

/// Tolerance of the implicit steppers' solver for the wanted error, as the mass-weighted RMS of the acceleration that
/// the solver may leave out, m/s^2. Where errors grow beyond the interval, the automatic stepper lowers it.
double acceptableResidual(const Simulation& simulation);

/// Whether a run can have led to this state of the automatic stepper and to this stepper in use. Checked for states
/// that come from a file.
bool isReachable(const AutoState& state, StepperKind inUse);

}  // namespace engine
