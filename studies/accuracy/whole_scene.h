// The automatic stepper beside the best fixed stepper and step over whole scenes: what both cost, at which errors.
// Called by `globular study accuracy --whole`, which writes the results.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "studies/accuracy/reference.h"
#include "studies/accuracy/step_ladder.h"

namespace studies {

struct WholeSettings {
    int windowCount = 12;        ///< largest number of windows in which errors are measured
    double windowSeconds = 0.2;  ///< length of a window, s of scene time
    int rounds = 3;              ///< how often a run is timed; long ones are timed once
};

/// A whole run of a fixed stepper, with the cheapest step that meets the wanted error.
struct FixedWholeRun {
    engine::StepperKind stepper = engine::StepperKind::velocityVerlet;
    double step = 0.0;            ///< s
    double error = 0.0;           ///< mean over the windows, radii per second
    double evaluationCost = 0.0;  ///< force evaluations of the whole run
    double seconds = 0.0;         ///< wall-clock time of the whole run
};

/// Error and cost of a fixed stepper over the windows.
struct FixedPoint {
    engine::StepperKind stepper = engine::StepperKind::velocityVerlet;
    LadderPoint point;
};

/// The error of the automatic stepper in one window of its run.
struct WholeWindowError {
    double from = 0.0;      ///< start of the window, s
    double meanStep = 0.0;  ///< s
    double error = 0.0;     ///< radii per second
    double change = 0.0;    ///< of the reference by the last halving of its step, radii per second
};

/// The results for one scene.
struct WholeScene {
    std::string name;               ///< in tables
    std::size_t particles = 0;      ///< at the end of the last window
    double duration = 0.0;          ///< s of scene time
    double wanted = 0.0;            ///< error that the scene asks for, radii per second
    double meanError = 0.0;         ///< of the automatic stepper over the windows, radii per second
    double largestError = 0.0;      ///< in a window, radii per second
    double change = 0.0;            ///< mean over the windows of the reference's by its last halving, radii per second
    double runEvaluations = 0.0;    ///< of the automatic stepper's steps, force evaluations
    double trialEvaluations = 0.0;  ///< of its trial runs, force evaluations
    double seconds = 0.0;           ///< wall-clock time of its run, trial runs included
    std::vector<WholeWindowError> windows;
    std::vector<FixedPoint> ladder;    ///< everything that was measured in the windows
    std::vector<FixedWholeRun> fixed;  ///< finished, and at most twice as dear in the windows as the best one

    /// Everything that the automatic stepper has spent, force evaluations.
    double evaluationCost() const { return runEvaluations + trialEvaluations; }
};

/// The fixed run with the least evaluations or seconds; nothing if none has finished.
std::optional<FixedWholeRun> bestBy(const std::vector<FixedWholeRun>& runs, double FixedWholeRun::*cost);

/// Runs a whole scene with the automatic stepper at the error that the scene asks for, finds the cheapest step of each
/// fixed stepper that meets that error in windows of the run, and runs the whole scene with it.
/// @throws engine::InstabilityError if the automatic stepper or a reference becomes unstable
WholeScene measureWhole(const std::string& name, const scenes::Scene& scene, const WholeSettings& settings,
                        const RunListener& listener);

/// CSV with a line for each scene.
std::string wholeCsv(const std::vector<WholeScene>& scenes);
/// CSV with a line for each fixed stepper of each scene.
std::string wholeSteppersCsv(const std::vector<WholeScene>& scenes);
/// CSV with a line for each step of each fixed stepper that was measured in the windows of each scene.
std::string wholeLadderCsv(const std::vector<WholeScene>& scenes);
/// CSV with a line for each window of each scene.
std::string wholeWindowsCsv(const std::vector<WholeScene>& scenes);

/// A sentence with the largest ratio of what the automatic stepper costs to the best fixed run, and the range of its
/// error over the wanted one.
std::string wholeSentence(const std::vector<WholeScene>& scenes);

}  // namespace studies
