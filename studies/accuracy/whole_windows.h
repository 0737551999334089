// Windows of a whole run of the automatic stepper: where the run stood at the start and at the end of each, and a
// reference run between the two. The errors of whole scenes are measured over them.
#pragma once

#include <vector>

#include "studies/accuracy/reference.h"
#include "studies/accuracy/window_run.h"

namespace studies {

/// A short part of a run of the automatic stepper.
struct WholeWindow {
    Window window;
    engine::Particles automatic;  ///< where the run itself, which is not restarted, has got at the end
    double meanStep = 0.0;        ///< of the run, s
    double evaluationCost = 0.0;  ///< of the run's steps, without its trial runs, in force evaluations
    bool isImplicit = false;      ///< whether the run has mostly taken implicit steps
    engine::Particles reference;  ///< of the reference run at the end
    double change = 0.0;          ///< of the reference by the last halving of its step, radii per second
};

/// A whole run of the automatic stepper, and windows of it.
struct AutomaticRun {
    WindowRun run;  ///< without particles
    std::vector<WholeWindow> windows;
};

/// The last frame of a scene, with which `globular simulate` ends; at least 1.
int lastFrameOf(const scenes::Scene& scene);

/// Runs a whole scene with the automatic stepper, at the error that the scene wants. The windows are spread evenly over
/// it and cover at most half of it. They are copies, so that the run has the states and the cost of a plain one.
/// @param windowCount  largest number of windows; those that begin without a particle are left out
/// @param windowSeconds  length of a window, s, rounded up to whole frames
/// @throws engine::InstabilityError
AutomaticRun runAutomatically(const scenes::Scene& scene, int windowCount, double windowSeconds);

/// Runs the reference of a window with a step a quarter of the mean step, then with half of that, and further as long
/// as halving changes it by more than a tenth of the wanted error (radii per second), at most twice more.
/// @throws engine::InstabilityError
void findReference(WholeWindow& window, double wanted, const RunListener& listener);

/// The error of a state at the end of a window: RMS distance from the reference over the particles that the window
/// began with and that neither of the two has lost, in radii per second of motion.
double errorOf(const WholeWindow& window, const engine::Particles& particles);

}  // namespace studies
