// At most two trials over many intervals, and interpolation between them.
#include "engine/error_control/long_error_estimate.h"

#include <algorithm>
#include <cmath>

#include "engine/stepping/steppers.h"

namespace engine {
namespace {

/// Chosen: factors by which a step may change without a second trial. Near a stepper's limit of stability twice the
/// step has been seen to err fifty times as much (`study accuracy solid`, velocity Verlet at 1/480 and 1/240 s).
constexpr double kSafeLess = 1.0 / 1.5;
constexpr double kSafeMore = 1.15;

/// Chosen: intervals that a trial covers at most; its two runs cost three or six times as many. Where frames are close
/// together the trial covers less time.
constexpr double kMostIntervals = 12.0;

/// Chosen: a longer step is worth a second trial from this factor on.
constexpr double kWorthMore = 1.4;

/// The step at which log-log interpolation between two trials, one with a smaller and one with a larger error, gives
/// the wanted error. Found by bisection, because a library's logarithms differ in their last bits from machine to
/// machine.
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
        // The horizon is 0: what a wrong velocity leads to happens within the trial.
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
        estimate.step = next;  // a longer step was not tried, or a shorter one does not help
    return estimate;
}

}  // namespace engine
