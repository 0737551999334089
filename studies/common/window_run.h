// One run over a window of a scene: from the same state with any stepper, timed. The unit that every study of accuracy
// is made of.
#pragma once

#include <optional>
#include <string>

#include "engine/run/advance.h"
#include "engine/run/diagnostics.h"
#include "scenes/model/scene.h"

namespace studies {

/// A stretch of a scene, and the state it begins with.
struct Window {
    scenes::Scene scene;
    engine::Simulation start;  ///< at the first frame
    int firstFrame = 0;
    int lastFrame = 0;

    double seconds() const;
};

/// The scene's own stepper brings it to the first frame: all runs begin there, so its errors are common to them.
/// Throws: engine::InstabilityError.
Window openWindow(const scenes::Scene& scene, int firstFrame, int frameCount);

/// What a run changes of the scene's set-up.
struct Variant {
    engine::StepperKind stepper = engine::StepperKind::velocityVerlet;
    double asked = 0.0;  ///< step in s; for the automatic stepper error in radii per second of motion
    std::optional<double> solverTolerance;  ///< nothing: the scene's
    engine::Precision precision = engine::Precision::doubles;
};

/// "velocity-verlet", or "velocity-verlet in float".
std::string nameOf(const Variant& variant);

/// Whether the variant is one of this stepper's in this arithmetic.
bool isOf(const Variant& variant, engine::StepperKind stepper,
          engine::Precision precision = engine::Precision::doubles);

enum class Ending { finished, unstable, tooSlow };

std::string nameOf(Ending ending);

struct WindowRun {
    Variant variant;
    Ending ending = Ending::finished;
    std::string failureMessage;  ///< of the InstabilityError
    double seconds = 0.0;        ///< wall clock
    engine::StepStatistics steps;
    engine::Particles particles;  ///< at the end; the state that an unfinished run broke off with
    engine::Energy energy;        ///< at the end of a finished run

    double errorEstimateCost = 0.0;  ///< what the automatic stepper's looks at its candidates cost besides the steps
    double evaluationCost = 0.0;     ///< all work, in passes over all pairs; see engine/step_cost.h
};

/// Runs the window once. A run that has taken longer than the limit (s) ends at the next frame as too slow.
WindowRun runWindow(const Window& window, const Variant& variant, double secondsLimit);

}  // namespace studies
