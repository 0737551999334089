// At most two measurements, and a line through them.
#include "engine/error_control/long_error_estimate.h"

#include <algorithm>
#include <cmath>

namespace engine {
namespace {

/// Chosen: a step may change by these factors unseen. Near a stepper's limit of stability twice the step has been
/// seen to err fifty times as much (`study accuracy solid`, velocity Verlet at 1/480 and 1/240 s).
constexpr double kSafeLess = 1.0 / 1.5;
constexpr double kSafeMore = 1.15;

/// Chosen: a far look costs three or six times as many; where frames are close together it does not reach as far.
constexpr double kMostIntervals = 12.0;

/// Chosen: what a longer step would save is worth another look from this factor on.
constexpr double kWorthMore = 1.4;

/// The step whose error is the wanted one on the line through two measurements, one less and one more, in logarithms:
/// by bisection, because a library's logarithms differ in their last bits from machine to machine.
double between(const Trial& less, const Trial& more, double wanted) {
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

FarLook lookFar(const Simulation& simulation, StepperKind stepper, double step, double interval) {
    const double wanted = simulation.setup.error;
    const double intervals = std::min(kMostIntervals, std::ceil(kFarSeconds / interval * (1.0 - 1e-9)));
    FarLook look;
    const auto lookAt = [&](double asked) {
        // What a wrong velocity leads to is seen, and not to be foreseen.
        const Trial trial = measure(simulation, {simulation.time + intervals * interval, stepper, asked, 0.0});
        look.spent += trial.spent;
        look.step = std::min(wantedStep(trial, wanted), interval);
        look.trial = trial;
        return trial;
    };
    const Trial first = lookAt(step);
    const double next = look.step;
    if (first.error <= wanted && next < kWorthMore * step) {
        look.step = std::clamp(next, step, std::min(kSafeMore * step, interval));
        return look;
    }
    if (first.error > wanted && next > kSafeLess * step) return look;
    const Trial second = lookAt(next);
    const Trial& less = next < step ? second : first;
    const Trial& more = next < step ? first : second;
    if (less.error > 0.0 && less.error <= wanted && more.error > wanted)
        look.step = between(less, more, wanted);
    else if (second.error <= wanted || second.error > kWasted * first.error)
        look.step = next;  // a longer one was not looked at; a shorter one does not help
    return look;
}

}  // namespace engine
