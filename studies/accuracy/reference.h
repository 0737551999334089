// The reference run that all other runs of a window are compared with, and the metric of the comparison: positions, or
// bulk statistics once the motion has become chaotic.
#pragma once

#include <functional>
#include <string_view>
#include <vector>

#include "studies/accuracy/window_run.h"

namespace studies {

enum class ErrorMetric {
    positions,  ///< rms distance between corresponding particles, radii
    statistics  ///< largest difference of center of mass, radius of gyration, R90 and z90, mean radii
};

std::string_view nameOf(ErrorMetric metric);

/// Distance between two states at the end of the window by a metric, radii.
double difference(const Window& window, ErrorMetric metric, const engine::Particles& a, const engine::Particles& b);

/// Distance by ErrorMetric::statistics, in the reference's mean radii.
double statisticsDifference(const engine::Particles& particles, const engine::Particles& reference);

/// How good the reference is, for the report.
struct ReferenceFacts {
    Variant variant;
    ErrorMetric metric = ErrorMetric::positions;
    double change = 0.0;          ///< of the result by the last halving of the step, radii
    double twinSeparation = 0.0;  ///< rms distance at the end of two runs that began 1e-9 radii apart, radii
    double resolution = 0.0;      ///< errors below this cannot be told from the reference's own, radii
    bool birthsDiffer = false;    ///< whether births depend on the step even in the finest runs
    bool settled = false;         ///< whether halving the step no longer matters beside the smallest measured error
    double seconds = 0.0;         ///< wall clock of the finest run
};

struct Reference {
    WindowRun run;
    ReferenceFacts facts;
};

/// Called after every run with its purpose: "run", "again" (timed once more), "twin" or "reference".
using RunListener = std::function<void(const WindowRun&, std::string_view purpose)>;

struct ReferenceBudget {
    double seconds = 0.0;  ///< for all runs of the reference; at least two are made
    RunListener listener;
};

/// Refines the better of velocity Verlet and implicit damping: its step is halved until the result changes by no more
/// than a twentieth of the smallest error among the measured runs, or until the budget is spent.
/// @param runs  runs of one stepper in the order of falling steps
/// @throws engine::InstabilityError if neither stepper finished two of the runs
Reference findReference(const Window& window, const std::vector<WindowRun>& runs, const ReferenceBudget& budget);

}  // namespace studies
