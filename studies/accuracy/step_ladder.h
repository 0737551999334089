// Finds the longest step with which a stepper meets a wanted error: walks along a ladder of steps and interpolates.
// Used by the study of accuracy in whole scenes.
#pragma once

#include <functional>
#include <optional>
#include <vector>

namespace studies {

/// Error and cost of a stepper at one step.
struct LadderPoint {
    double step = 0.0;         ///< s
    double error = 0.0;        ///< radii per second; infinite if a run became unstable
    double evaluations = 0.0;  ///< force evaluations
    double rejected = 0.0;     ///< rejected steps over accepted ones
};

/// Measures one step (s) of a ladder; nothing if it costs too much.
using LadderRun = std::function<std::optional<LadderPoint>(double step)>;

/// Measures steps on both sides of the longest one that meets the wanted error, and shorter ones as long as rejected
/// steps make them cheaper. The steps of the ladder divide a frame evenly and differ by factors of about sqrt(2); the
/// longest is a frame.
/// @param first  step at which the walk starts, s
/// @return  the points that were measured, in any order
std::vector<LadderPoint> walkLadder(const LadderRun& run, double frameSeconds, double first, double wanted);

/// The longest step that meets the wanted error, log-linear between the points of the ladder on both sides, or a point
/// that meets it and costs less, where rejected steps make long steps expensive.
/// @return  nothing if no point meets it; the longest point if all do
std::optional<LadderPoint> longestWithin(std::vector<LadderPoint> points, double wanted);

/// Measures the two steps that divide a frame evenly and are next to longestWithin(), and adds them to the points.
/// @return  the point that meets the wanted error at the least cost; nothing if none does
std::optional<LadderPoint> refine(std::vector<LadderPoint>& points, const LadderRun& run, double frameSeconds,
                                  double wanted);

}  // namespace studies
