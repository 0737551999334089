// A timed run over a window of a scene by any stepper, from one state. The study of accuracy consists of such runs.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "engine/run/advance.h"
#include "engine/run/diagnostics.h"
#include "scenes/model/scene.h"

namespace studies {

/// Runs longer than this (s) are timed only once. Chosen: their time varies little from one run to the next.
inline constexpr double kLongRun = 5.0;

/// A range of frames of a scene, and the simulation at the first of them.
struct Window {
    scenes::Scene scene;
    engine::Simulation start;  ///< the simulation at the first frame
    int firstFrame = 0;
    int lastFrame = 0;

    double seconds() const;  ///< length of the window, s of scene time
};

/// Advances the scene with its own stepper to the first frame of a window. All runs over the window begin with this
/// state, so that errors made before it are the same in all of them.
/// @throws engine::InstabilityError
Window openWindow(const scenes::Scene& scene, int firstFrame, int frameCount);

/// What a run changes in the scene: the stepper and its step, and the precision.
struct Variant {
    engine::StepperKind stepper = engine::StepperKind::velocityVerlet;
    double asked = 0.0;  ///< step, s; for the automatic stepper the wanted error, radii per second of motion
    std::optional<double> solverTolerance;  ///< tolerance of the implicit steppers; nothing: the scene's
    engine::Precision precision = engine::Precision::doubles;
};

/// The name of a stepper and its precision, for example "velocity-verlet" or "velocity-verlet in float".
std::string nameOf(const Variant& variant);

/// Whether a run uses the given stepper at the given precision.
bool isOf(const Variant& variant, engine::StepperKind stepper,
          engine::Precision precision = engine::Precision::doubles);

/// How a run ended: at the end of the window, by an InstabilityError, or at the time limit.
enum class Ending { finished, unstable, tooSlow };

std::string_view nameOf(Ending ending);

/// What the automatic stepper has learned in a run of its own that has got to a window, and the price of learning.
struct LeadIn {
    engine::AutoState state;
    engine::StepperKind stepper = engine::StepperKind::velocityVerlet;
    double trialShare = 0.0;  ///< cost of the trial runs over that of the run, from its start to the end of the window
};

/// A run over a window, and its results.
struct WindowRun {
    Variant variant;
    Ending ending = Ending::finished;
    std::string failureMessage;  ///< message of the InstabilityError; empty if there was none
    double seconds = 0.0;        ///< wall-clock time of the run
    engine::StepStatistics steps;
    engine::Particles particles;  ///< particles at the end, or when an unfinished run broke off
    engine::Energy energy;        ///< energy at the end of a finished run

    double errorEstimateCost = 0.0;  ///< cost of the automatic stepper's trial runs, in force evaluations
    double evaluationCost = 0.0;     ///< cost of the whole run, trial runs included, in force evaluations
    std::optional<LeadIn> leadIn;    ///< of the automatic stepper, in a window that begins later than the scene
};

/// Runs a window of a scene once. After secondsLimit (s of wall-clock time) it ends at the next frame as too slow.
///
/// The automatic stepper starts as in a run that has got to the window: with the steps, calibrations and stepper of its
/// lead-in. Its trial runs are some dozens of frames apart, so that a short window holds either none or one that costs
/// as much as most of the window. The run makes none that is due, and is charged instead, in evaluations and in
/// seconds, with the share that the lead-in and the window spend on them together. In a window that begins with the
/// scene it makes all its trial runs, and there is no lead-in.
/// @param leadIn  that of an earlier run of this variant; made here if there is none
WindowRun runWindow(const Window& window, const Variant& variant, double secondsLimit,
                    std::optional<LeadIn> leadIn = {});

/// Advances a simulation frame by frame against the clock to the last frame, and leaves it there. Of the result only
/// the variant and the particles are not set.
/// @param afterFrame  called with the number of every frame when it is reached, outside the time
WindowRun timeFrames(const scenes::Scene& scene, engine::Simulation& simulation, int firstFrame, int lastFrame,
                     double secondsLimit, const std::function<void(int)>& afterFrame = {});

}  // namespace studies
