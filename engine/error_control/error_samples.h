// Estimates of the error of a run with a fixed step, made now and then while it runs. They are bounded by their cost in
// force evaluations, which is counted instead of timed, so that a run and its resumed half make the same estimates.
// Called by the loops over frames.
#pragma once

#include "engine/state/simulation.h"

namespace engine {

/// Most that the error samples of a run cost, as a share of the force evaluations of the run itself. A sample that
/// needs more than was predicted is given up one step later, so that a run of few steps may spend a little more.
inline constexpr double kErrorSampleShare = 0.1;

/// Error estimates of a run with a fixed step, in radii per second of motion.
struct ErrorSamples {
    int count = 0;
    double sum = 0.0;
    double largest = 0.0;
    double evaluationCost = 0.0;  ///< what the estimates cost, in force evaluations
};

/// Estimates the error of what follows the present state at the step of the run, over as many steps of the next frame
/// as all samples together may cost, and adds it to the samples. Does nothing where that is less than a step, for the
/// automatic stepper, which estimates its own error, and for a run that becomes unstable within that frame.
/// @param frameSeconds  length of a frame, s
/// @param evaluationsOfFrame  what the last frame cost, in force evaluations
void addSample(ErrorSamples& samples, const Simulation& simulation, double frameSeconds, double evaluationsOfFrame);

}  // namespace engine
