// Speed against error of one scene: every stepper over a range of steps, from one state over one window, against a
// reference that is fine enough. Called by `globular study accuracy`, which writes what comes out.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "studies/accuracy/accuracy_summary.h"
#include "studies/common/reference.h"
#include "studies/common/window_run.h"

namespace studies {

struct AccuracySettings {
    int firstFrame = 0;
    int frameCount = 15;
    std::vector<int> stepsPerFrame = {1, 2, 4, 8, 16, 32, 64};    ///< of the fixed steppers, rising
    std::vector<double> errors = {1e-1, 3e-2, 1e-2, 3e-3, 1e-3};  ///< of the automatic one, radii per second
    int rounds = 3;                                               ///< of all runs but long ones; short ones get more
    double runLimit = 60.0;                                       ///< a run that takes longer is too slow, s
    double referenceBudget = 180.0;                               ///< for all runs of the reference, s
};

/// What the study found in a scene.
struct SceneAccuracy {
    std::string name;               ///< the caller's
    std::string title;              ///< the scene's
    std::size_t particleCount = 0;  ///< at the start of the window
    double from = 0.0;              ///< s
    double window = 0.0;            ///< s
    double productCost = 0.0;       ///< of the implicit steppers' matrix with a vector, passes over all pairs
    ReferenceFacts reference;
    std::vector<AccuracyRow> rows;
    std::vector<OrderRow> orders;
    std::vector<AutoRow> autos;
};

/// Runs all of it. Throws: engine::InstabilityError where the scene does not reach the window, or nothing finishes
/// that could be a reference.
SceneAccuracy measureAccuracy(const std::string& name, const scenes::Scene& scene, const AccuracySettings& settings,
                              const RunListener& listener);

}  // namespace studies
