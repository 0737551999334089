// Walks along the ladder of steps and interpolates between its points. See step_ladder.h.
#include "studies/accuracy/step_ladder.h"

#include <algorithm>
#include <cmath>

namespace studies {
namespace {

/// The last step of the ladder is a frame over 2^(kLastRung / 2), 1024. Chosen: far below any useful step.
constexpr int kLastRung = 20;

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
    int rung = rungOf(first, frameSeconds);
    const std::optional<LadderPoint> start = run(stepAt(rung, frameSeconds));
    if (start) points.push_back(*start);
    const bool toLonger = !start || start->error <= wanted;
    for (rung += toLonger ? -1 : 1; rung >= 0 && rung <= kLastRung; rung += toLonger ? -1 : 1) {
        const std::optional<LadderPoint> point = run(stepAt(rung, frameSeconds));
        if (!point) {
            if (points.empty()) continue;  // longer steps may cost less
            break;
        }
        points.push_back(*point);
        if ((point->error <= wanted) != toLonger) break;
    }
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
        best = {between(found->step, longer.step, t), wanted, between(found->evaluations, longer.evaluations, t)};
    }
    for (const LadderPoint& point : points)
        if (meets(point) && point.evaluations < best.evaluations) best = point;
    return best;
}

}  // namespace studies
