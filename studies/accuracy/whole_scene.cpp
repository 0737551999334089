// Measures the automatic and the fixed steppers over a whole scene. See whole_scene.h.
#include "studies/accuracy/whole_scene.h"

#include <algorithm>
#include <array>

#include "engine/stepping/take_step.h"
#include "studies/accuracy/step_ladder.h"
#include "studies/accuracy/whole_windows.h"
#include "studies/common/state_difference.h"
#include "studies/common/timing.h"

namespace studies {
namespace {

using engine::StepperKind;

/// The fixed steppers that are compared: all but the paper's, which has no checks of its steps.
constexpr std::array kFixed = {StepperKind::velocityVerlet, StepperKind::leapfrog, StepperKind::implicitDamping,
                               StepperKind::linearlyImplicit};

/// A step is not measured to the end, nor a whole run made, if it costs more than this many times the best so far.
constexpr double kTooExpensive = 2.0;

/// The same over the automatic stepper's own steps, as long as there is no best. Chosen: above kTooExpensive, because
/// the automatic stepper may have taken steps that are too long.
constexpr double kFarTooExpensive = 4.0;

/// Measures a stepper at a step in all windows. Returns nothing if that costs more than `most` force evaluations.
std::optional<LadderPoint> measurePoint(const std::vector<WholeWindow>& windows, const Variant& variant, double most,
                                        const RunListener& listener) {
    WindowRun all;
    all.variant = variant;
    double errors = 0.0;
    for (const WholeWindow& window : windows) {
        const WindowRun run = runWindow(window.window, variant, kInfinity);
        all.seconds += run.seconds;
        all.evaluationCost += run.evaluationCost;
        all.steps += run.steps;
        all.ending = run.ending != Ending::finished ? run.ending
                     : all.evaluationCost > most    ? Ending::tooSlow
                                                    : Ending::finished;
        if (all.ending != Ending::finished) break;
        errors += errorOf(window, run.particles);
    }
    listener(all, "windows");
    if (all.ending == Ending::tooSlow) return std::nullopt;
    const double mean = all.ending == Ending::unstable ? kInfinity : errors / static_cast<double>(windows.size());
    const double rejected =
        static_cast<double>(all.steps.rejected) / static_cast<double>(std::max<std::uint64_t>(1, all.steps.count));
    return LadderPoint{variant.asked, mean, all.evaluationCost, rejected};
}

/// The steps of the fixed steppers that meet the wanted error, by rising cost in the windows.
/// @param ladder  receives everything that was measured
std::vector<FixedPoint> choicesIn(const scenes::Scene& scene, const std::vector<WholeWindow>& windows,
                                  std::vector<FixedPoint>& ladder, const RunListener& listener) {
    double most = 0.0;
    double step = 0.0;
    std::size_t implicit = 0;
    for (const WholeWindow& window : windows) {
        most += kFarTooExpensive * window.evaluationCost;
        step += window.meanStep / static_cast<double>(windows.size());
        implicit += window.isImplicit ? 1 : 0;
    }
    std::array steppers = kFixed;  // what the automatic stepper took comes first, because it is likely to be cheap
    if (2 * implicit > windows.size()) std::ranges::reverse(steppers);
    const double frame = scenes::frameTime(scene, 1);
    std::vector<FixedPoint> choices;
    for (const StepperKind stepper : steppers) {
        const LadderRun run = [&](double each) { return measurePoint(windows, {stepper, each, {}}, most, listener); };
        auto points = walkLadder(run, frame, step, scene.setup.error);
        const auto point = refine(points, run, frame, scene.setup.error);
        for (const LadderPoint& each : points) ladder.push_back({stepper, each});
        if (!point) continue;
        choices.push_back({stepper, *point});
        most = std::min(most, kTooExpensive * point->evaluations);
    }
    std::ranges::sort(choices, {}, [](const FixedPoint& choice) { return choice.point.evaluations; });
    return choices;
}

/// Runs a whole scene with a stepper.
WindowRun runScene(const scenes::Scene& scene, const Variant& variant, double secondsLimit) {
    engine::Setup setup = scene.setup;
    setup.stepper = variant.stepper;
    if (variant.stepper != StepperKind::automatic) setup.step = variant.asked;
    engine::Simulation simulation = engine::start(setup);
    WindowRun run = timeFrames(scene, simulation, 0, lastFrameOf(scene), secondsLimit);
    run.variant = variant;
    return run;
}

/// Runs the whole scene with those choices that may be the best.
std::vector<FixedWholeRun> runChoices(const scenes::Scene& scene, const std::vector<FixedPoint>& choices,
                                      double secondsLimit, const RunListener& listener) {
    std::vector<FixedWholeRun> runs;
    for (const FixedPoint& choice : choices) {
        if (choice.point.evaluations > kTooExpensive * choices.front().point.evaluations) continue;
        const WindowRun run = runScene(scene, {choice.stepper, choice.point.step, {}}, secondsLimit);
        listener(run, "whole");
        if (run.ending != Ending::finished) continue;
        runs.push_back({choice.stepper, choice.point.step, choice.point.error, run.evaluationCost, run.seconds});
    }
    return runs;
}

/// Times the runs again, in turn with that of the automatic stepper, and takes the medians.
void timeAgain(const scenes::Scene& scene, WholeScene& whole, int rounds, const RunListener& listener) {
    std::vector<Variant> variants = {{StepperKind::automatic, whole.wanted, {}}};
    std::vector<double*> medians = {&whole.seconds};
    for (FixedWholeRun& run : whole.fixed) {
        variants.push_back({run.stepper, run.step, {}});
        medians.push_back(&run.seconds);
    }
    std::vector<std::vector<double>> seconds;
    for (const double* first : medians) seconds.push_back({*first});
    for (int round = 1; round < rounds; ++round)
        for (std::size_t r = 0; r < variants.size(); ++r) {
            if (seconds[r].front() > kLongRun) continue;
            const WindowRun run = runScene(scene, variants[r], kInfinity);
            listener(run, "again");
            seconds[r].push_back(run.seconds);
        }
    for (std::size_t r = 0; r < medians.size(); ++r) *medians[r] = median(seconds[r]);
}

void addErrors(WholeScene& whole, const std::vector<WholeWindow>& windows) {
    for (const WholeWindow& window : windows) {
        const double error = errorOf(window, window.automatic);
        whole.windows.push_back({window.window.start.time, window.meanStep, error, window.change});
        whole.meanError += error / static_cast<double>(windows.size());
        whole.largestError = std::max(whole.largestError, error);
        whole.change += window.change / static_cast<double>(windows.size());
    }
    whole.particles = windows.empty() ? 0 : windows.back().automatic.count();
}

}  // namespace

std::optional<FixedWholeRun> bestBy(const std::vector<FixedWholeRun>& runs, double FixedWholeRun::*cost) {
    const auto best = std::ranges::min_element(runs, {}, cost);
    return best == runs.end() ? std::nullopt : std::optional(*best);
}

WholeScene measureWhole(const std::string& name, const scenes::Scene& scene, const WholeSettings& settings,
                        const RunListener& listener) {
    WholeScene whole;
    whole.name = name;
    whole.duration = scenes::frameTime(scene, lastFrameOf(scene));
    whole.wanted = scene.setup.error;
    AutomaticRun automatic = runAutomatically(scene, settings.windowCount, settings.windowSeconds);
    listener(automatic.run, "whole");
    whole.trialEvaluations = automatic.run.errorEstimateCost;
    whole.runEvaluations = automatic.run.evaluationCost - whole.trialEvaluations;
    whole.seconds = automatic.run.seconds;
    for (WholeWindow& window : automatic.windows) findReference(window, whole.wanted, listener);
    addErrors(whole, automatic.windows);
    if (automatic.windows.empty()) return whole;  // there is no motion
    const double secondsLimit = 2.0 * kFarTooExpensive * whole.seconds;
    whole.fixed =
        runChoices(scene, choicesIn(scene, automatic.windows, whole.ladder, listener), secondsLimit, listener);
    timeAgain(scene, whole, settings.rounds, listener);
    return whole;
}

}  // namespace studies
