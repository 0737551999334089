// The run that all others are measured against, and in what they are measured: positions, or statistics once the
// motion has become chaotic.
#pragma once

#include <functional>
#include <string_view>
#include <vector>

#include "studies/common/window_run.h"

namespace studies {

enum class ErrorMetric {
    positions,  ///< rms distance over the particles that both have, radii
    statistics  ///< largest difference of center of mass, radius of gyration, R90 and z90, radii
};

std::string_view nameOf(ErrorMetric measure);

/// How far two states at the end of the window are apart, in radii.
double difference(const Window& window, ErrorMetric measure, const engine::Particles& a, const engine::Particles& b);

/// Differences of the four statistics, in mean radii.
double statisticsDifference(const engine::Particles& particles, const engine::Particles& reference);

/// What a reader has to know of the reference.
struct ReferenceFacts {
    Variant variant;
    ErrorMetric measure = ErrorMetric::positions;
    double change = 0.0;          ///< by the last halving of its step, radii
    double twinSeparation = 0.0;  ///< rms, of two runs that began 1e-9 radii apart, radii
    double resolution = 0.0;      ///< errors below it are not told from its own, radii
    bool birthsDiffer = false;    ///< even of the finest runs, so that births depend on the step
    bool settled = false;         ///< halving its step no longer matters to the smallest error measured
    double seconds = 0.0;         ///< of its finest run
};

struct Reference {
    WindowRun run;
    ReferenceFacts facts;
};

/// Told of every run when it is done, and what it was for: "run", "again", "twin" or "reference".
using RunListener = std::function<void(const WindowRun&, std::string_view purpose)>;

struct ReferenceBudget {
    double seconds = 0.0;  ///< for all runs together; at least two are made
    RunListener listener;
};

/// The better of velocity Verlet and implicit damping, halved until its change is a twentieth of the smallest error
/// among the measured runs, or until the budget is spent.
/// Shape:  runs of one stepper stand with falling steps.
/// Throws: engine::InstabilityError where neither stepper finished two of the runs.
Reference findReference(const Window& window, const std::vector<WindowRun>& runs, const ReferenceBudget& budget);

}  // namespace studies
