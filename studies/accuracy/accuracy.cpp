// Makes and times the runs of all steppers on a scene, finds the reference run and compares them. See accuracy.h.
#include "studies/accuracy/accuracy.h"

#include <algorithm>

#include "engine/error_control/step_cost.h"
#include "engine/stepping/take_step.h"

namespace studies {
namespace {

/// Short runs are repeated until they have taken kTimed seconds in total, but at most kMostRounds times. Chosen.
constexpr double kTimed = 0.3;
constexpr int kMostRounds = 12;

std::vector<Variant> variantsOf(const scenes::Scene& scene, const AccuracySettings& settings) {
    std::vector<Variant> variants;
    for (const engine::StepperKind stepper : engine::kSteppers) {
        if (stepper == engine::StepperKind::automatic)
            for (const double error : settings.errors) variants.push_back({stepper, error, {}});
        else
            for (const int count : settings.stepsPerFrame)
                variants.push_back({stepper, 1.0 / (scene.fps.framesIn(1.0) * count), {}});
    }
    // Single precision is measured with the stepper that spends nearly all of its time on pair forces.
    for (const int count : settings.stepsPerFrame)
        variants.push_back({engine::StepperKind::velocityVerlet,
                            1.0 / (scene.fps.framesIn(1.0) * count),
                            {},
                            engine::Precision::singles});
    return variants;
}

/// Whether a run is repeated once more to time it better.
/// @param spent  total seconds of all repetitions of the run so far
/// @param round  number of repetitions so far
/// @param rounds  number of repetitions that the settings ask for
bool isTimedAgain(const WindowRun& run, double spent, int round, int rounds) {
    if (run.ending != Ending::finished || rounds == 1) return false;
    return round < rounds ? run.seconds < kLongRun : spent < kTimed;
}

/// Makes every run once, then repeats the short ones, the shortest most often. Each round repeats all of them, so that
/// a passing load on the machine does not slow down one run alone. The time of a run is the least of its repetitions,
/// because other load on the machine can only add to it.
std::vector<WindowRun> timedRuns(const Window& window, const AccuracySettings& settings, const RunListener& listener) {
    std::vector<WindowRun> runs;
    for (const Variant& variant : variantsOf(window.scene, settings)) {
        runs.push_back(runWindow(window, variant, settings.runLimit));
        listener(runs.back(), "run");
    }
    std::vector<double> spent;
    for (const WindowRun& run : runs) spent.push_back(run.seconds);
    for (int round = 1; round < std::max(kMostRounds, settings.rounds); ++round)
        for (std::size_t r = 0; r < runs.size(); ++r) {
            WindowRun& run = runs[r];
            if (!isTimedAgain(run, spent[r], round, settings.rounds)) continue;
            const WindowRun next = runWindow(window, run.variant, settings.runLimit, run.leadIn);
            run.seconds = std::min(run.seconds, next.seconds);
            spent[r] += next.seconds;
            listener(next, "again");
        }
    return runs;
}

}  // namespace

SceneAccuracy measureAccuracy(const std::string& name, const scenes::Scene& scene, const AccuracySettings& settings,
                              const RunListener& listener) {
    const Window window = openWindow(scene, settings.firstFrame, settings.frameCount);
    const std::vector<WindowRun> runs = timedRuns(window, settings, listener);
    const Reference reference = findReference(window, runs, settings.referenceBudget, listener);

    SceneAccuracy accuracy;
    accuracy.name = name;
    accuracy.title = scene.title;
    accuracy.particleCount = window.start.particles.count();
    accuracy.from = scenes::frameTime(scene, window.firstFrame);
    accuracy.window = window.seconds();
    accuracy.productCost = engine::implicitCosts(scene.setup).product;
    accuracy.reference = reference.facts;
    for (const WindowRun& run : runs) accuracy.rows.push_back(rowOf(window, run, reference));
    accuracy.orders = ordersOf(accuracy.rows);
    accuracy.autos = autosOf(accuracy.rows, accuracy.window);
    return accuracy;
}

}  // namespace studies
