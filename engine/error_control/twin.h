// Trial runs that go ahead of the run, with longer steps or with another stepper. When the run gets as far it is
// compared with them, which tells how far both are from the true motion: the estimates of single steps know neither how
// errors grow by collisions nor how they shrink by damping. Used by the automatic stepper.
#pragma once

#include "engine/state/simulation.h"

namespace engine {

/// Duration of a twin, s, rounded up to whole intervals. Chosen: as long as an impact takes, and short enough that
/// later collisions do not multiply the errors of the impact.
inline constexpr double kTwinSeconds = 0.2;

/// Number of intervals of the given length (s) that a twin lasts; at most twelve.
std::uint64_t twinIntervals(double interval);

/// Whether particles are emitted in the time that a twin lasts.
/// @param interval  length of an interval, s
bool isEmitting(const Simulation& simulation, double interval);

/// Factor by which the steps of a twin of the stepper in use are longer than those of the run.
inline constexpr double kTwinFactor = 1.5;

/// Starts a twin of the stepper in use. Its steps are controlled like those of the run, for a larger error. It is given
/// up, and leaves no twin, when it has cost more than the run, with its shorter steps, will.
/// @param interval       length of an interval, s
/// @param mostPerSecond  what the run costs, force evaluations per second of motion
void sendTwin(Simulation& simulation, double interval, double mostPerSecond);

/// Starts a twin of another stepper, which lasts half as long and is given up, and leaves no twin, as soon as it has
/// cost clearly more than the run will until then.
void sendCandidate(Simulation& simulation, StepperKind stepper, double interval, double mostPerSecond);

/// What a twin has taught about the run, when the run has got as far.
struct Comparison {
    double distance = 0.0;  ///< RMS distance of the particles of the two, radii per second of motion
    double estimate = 0.0;  ///< mean estimate of the run's steps, without calibration, radii per second
    double cost = 0.0;      ///< of the run, force evaluations per second of motion
};

/// Compares the run, which has got to the end of the twin.
Comparison compareWithTwin(const Simulation& simulation);

}  // namespace engine
