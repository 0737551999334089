// Walks along the ladder of steps and interpolates between its points. See step_ladder.h.
#include "studies/accuracy/step_ladder.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace studies {
namespace {

/// Last rung of the ladder, whose step is a frame over 1448. Chosen: far below any useful step.
constexpr int kLastRung = 20;

/// From this share of rejected steps on, shorter steps may cost less. Chosen.
constexpr double kOftenRejected = 0.05;

/// Number of steps that cost too much after which a walk is given up. Chosen: costs change by a factor of four
/// meanwhile.
constexpr int kMostTooExpensive = 5;

/// The step at a rung of the ladder, s.
double stepAt(int rung, double frameSeconds) {
    return frameSeconds / (rung == 0 ? 1.0 : std::round(std::exp2(0.5 * (rung + 1))));
}

/// The rung whose step is closest to a step (s) in the ratio.
int rungOf(double step, double frameSeconds) {
    int best = 0;
    const auto off = [&](int rung) { return std::abs(std::log(stepAt(rung, frameSeconds) / step)); };
    for (int rung = 1; rung <= kLastRung; ++rung)
        if (off(rung) < off(best)) best = rung;
    return best;
}

/// A value that is log-linear between a (t = 0) and b (t = 1).
double between(double a, double b, double t) {
    return std::exp((1.0 - t) * std::log(a) + t * std::log(b));
}

}  // namespace

std::vector<LadderPoint> walkLadder(const LadderRun& run, double frameSeconds, double first, double wanted) {
    std::vector<LadderPoint> points;
    // Measures rungs from one on, in one direction, until isLast(point), or one costs too much after others did not.
    const auto walk = [&](int rung, int direction, const auto& isLast) {
        for (int tooExpensive = 0; rung >= 0 && rung <= kLastRung; rung += direction) {
            const std::optional<LadderPoint> point = run(stepAt(rung, frameSeconds));
            if (point) points.push_back(*point);
            if (point ? isLast(*point) : !points.empty() || ++tooExpensive == kMostTooExpensive) return;
        }
    };
    const auto meets = [&](const LadderPoint& point) { return point.error <= wanted; };
    const int start = rungOf(first, frameSeconds);
    walk(start, -1, [&](const LadderPoint& point) { return !meets(point); });
    const bool metNothing = std::ranges::none_of(points, meets);
    if (metNothing && points.size() <= 1) walk(start + 1, 1, meets);
    const auto shortest = std::ranges::min_element(points, {}, &LadderPoint::step);
    if (shortest == points.end() || !meets(*shortest) || shortest->rejected < kOftenRejected) return points;
    double least = shortest->evaluations;
    walk(rungOf(shortest->step, frameSeconds) + 1, 1,
         [&](const LadderPoint& point) { return std::exchange(least, point.evaluations) < point.evaluations; });
    return points;
}

std::optional<LadderPoint> longestWithin(std::vector<LadderPoint> points, double wanted) {
    std::ranges::sort(points, std::ranges::greater(), &LadderPoint::step);
    const auto meets = [&](const LadderPoint& point) { return point.error <= wanted; };
    const auto found = std::ranges::find_if(points, meets);
    if (found == points.end()) return std::nullopt;
    LadderPoint best = *found;
    if (found != points.begin() && std::isfinite(found[-1].error) && found->error > 0.0) {
        const LadderPoint& longer = found[-1];
        const double t = std::log(wanted / found->error) / std::log(longer.error / found->error);
        best = {between(found->step, longer.step, t), wanted, between(found->evaluations, longer.evaluations, t),
                std::max(found->rejected, longer.rejected)};
    }
    for (const LadderPoint& point : points)
        if (meets(point) && point.evaluations < best.evaluations) best = point;
    return best;
}

std::optional<LadderPoint> refine(std::vector<LadderPoint>& points, const LadderRun& run, double frameSeconds,
                                  double wanted) {
    const std::optional<LadderPoint> guess = longestWithin(points, wanted);
    if (!guess) return std::nullopt;
    const double count = frameSeconds / guess->step;
    for (const double each : {std::floor(count + 1e-9), std::ceil(count - 1e-9)}) {
        const double step = frameSeconds / each;
        const auto isSame = [&](const LadderPoint& point) { return std::abs(point.step - step) < 1e-9 * step; };
        if (std::ranges::any_of(points, isSame)) continue;
        if (const std::optional<LadderPoint> point = run(step)) points.push_back(*point);
    }
    std::optional<LadderPoint> best;
    for (const LadderPoint& point : points)
        if (point.error <= wanted && (!best || point.evaluations < best->evaluations)) best = point;
    return best;
}

}  // namespace studies
