// The error estimate over many intervals: at most two trial runs, and interpolation between their results.
#include "engine/error_control/long_error_estimate.h"

#include <algorithm>
#include <cmath>

#include "engine/stepping/take_step.h"

namespace engine {
namespace {

/// Factors by which a step may change without a second trial run. Chosen: near a stepper's limit of stability, twice
/// the step was seen to cause fifty times the error (`study accuracy solid`, velocity Verlet at 1/480 and 1/240 s).
constexpr double kSafeLess = 1.0 / 1.5;
constexpr double kSafeMore = 1.15;

/// Largest number of intervals in a trial run. With short intervals a trial therefore covers less time. Chosen: the two
/// runs of a trial together cost three to six times as much as the intervals that they cover.
constexpr double kMostIntervals = 12.0;

/// A longer step is tried only if it is longer by at least this factor. Chosen.
constexpr double kWorthMore = 1.4;

/// The step at which log-log interpolation between two trials, one with a smaller and one with a larger error than
/// wanted, gives the wanted error. It is found by bisection, because the logarithms of a library differ in their last
/// bits from machine to machine.
double interpolatedStep(const Trial& less, const Trial& more, double wanted) {
    constexpr int kHalvings = 40;
    struct Point {
        double step, error;
    };
    Point low{less.step, less.error};
    Point high{more.step, more.error};
    for (int k = 0; k < kHalvings; ++k) {
        const Point middle{std::sqrt(low.step) * std::sqrt(high.step), std::sqrt(low.error) * std::sqrt(high.error)};
        (middle.error <= wanted ? low : high) = middle;
    }
    return low.step;
}

}  // namespace

LongEstimate estimateLongError(const Simulation& simulation, StepperKind stepper, double step, double interval) {
    const double wanted = simulation.setup.error;
    const double intervalCount = std::min(kMostIntervals, stepCount(kLongEstimateSeconds, interval));
    LongEstimate estimate;
    const auto measureAt = [&](double asked) {
        // The horizon is 0, because a trial is long enough to show what an error in a velocity leads to.
        const Trial trial = measure(simulation, {simulation.time + intervalCount * interval, stepper, asked, 0.0});
        estimate.spent += trial.spent;
        estimate.step = std::min(wantedStep(trial, wanted), interval);
        estimate.trial = trial;
        return trial;
    };
    const Trial first = measureAt(step);
    const double next = estimate.step;
    if (first.error <= wanted && next < kWorthMore * step) {
        estimate.step = std::clamp(next, step, std::min(kSafeMore * step, interval));
        return estimate;
    }
    if (first.error > wanted && next > kSafeLess * step) return estimate;
    const Trial second = measureAt(next);
    const Trial& less = next < step ? second : first;
    const Trial& more = next < step ? first : second;
    if (less.error > 0.0 && less.error <= wanted && more.error > wanted)
        estimate.step = interpolatedStep(less, more, wanted);
    else if (second.error <= wanted || second.error > kWasted * first.error)
        estimate.step = next;  // the longer step meets the wanted error, or the shorter one has no smaller error
    return estimate;
}

}  // namespace engine
