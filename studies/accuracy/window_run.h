// One run over a window of a scene, timed, from the same state with any stepper: the unit that the study of accuracy is
// made of.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "engine/run/advance.h"
#include "engine/run/diagnostics.h"
#include "scenes/model/scene.h"

namespace studies {

/// A stretch of a scene, and the state that it begins with.
struct Window {
    scenes::Scene scene;
    engine::Simulation start;  ///< the state at the first frame
    int firstFrame = 0;
    int lastFrame = 0;

    double seconds() const;  ///< length of the window
};

/// Advances the scene with its own stepper to the first frame. All runs over the window begin with that state, so the
/// errors made before it are common to them.
/// @throws engine::InstabilityError
Window openWindow(const scenes::Scene& scene, int firstFrame, int frameCount);

/// What a run changes of the scene's setup.
struct Variant {
    engine::StepperKind stepper = engine::StepperKind::velocityVerlet;
    double asked = 0.0;  ///< step in s; for the automatic stepper, error in radii per second of motion
    std::optional<double> solverTolerance;  ///< nothing: the scene's
    engine::Precision precision = engine::Precision::doubles;
};

/// For example "velocity-verlet" or "velocity-verlet in float".
std::string nameOf(const Variant& variant);

/// Whether the variant uses this stepper at this precision.
bool isOf(const Variant& variant, engine::StepperKind stepper,
          engine::Precision precision = engine::Precision::doubles);

enum class Ending { finished, unstable, tooSlow };

std::string_view nameOf(Ending ending);

struct WindowRun {
    Variant variant;
    Ending ending = Ending::finished;
    std::string failureMessage;  ///< of the InstabilityError
    double seconds = 0.0;        ///< wall clock
    engine::StepStatistics steps;
    engine::Particles particles;  ///< at the end, or when an unfinished run broke off
    engine::Energy energy;        ///< at the end of a finished run

    double errorEstimateCost = 0.0;  ///< of the automatic stepper's error estimates, in force evaluations
    double evaluationCost = 0.0;     ///< of all work, in force evaluations; see engine/error_control/step_cost.h
};

/// Runs the window once. A run that exceeds the limit (s) ends at the next frame as too slow.
WindowRun runWindow(const Window& window, const Variant& variant, double secondsLimit);

}  // namespace studies
