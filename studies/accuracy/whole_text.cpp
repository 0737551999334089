// The results of the study of accuracy in whole scenes as text: CSV tables and a sentence. See whole_scene.h.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/stepping/take_step.h"
#include "studies/accuracy/whole_scene.h"
#include "studies/common/report.h"

namespace studies {
namespace {

/// Five CSV fields: the best fixed run, and the automatic stepper's cost over it; empty without one.
std::string comparison(const WholeScene& scene, double FixedWholeRun::*cost, double automatic) {
    const auto best = bestBy(scene.fixed, cost);
    if (!best) return ",,,,";
    return csvFields(engine::nameOf(best->stepper), best->step, best->evaluationCost, best->seconds,
                     automatic / (*best).*cost);
}

}  // namespace

std::string wholeCsv(const std::vector<WholeScene>& scenes) {
    std::string csv =
        "scene,particles,duration_s,windows,wanted_radii_per_s,mean_error_radii_per_s,largest_error_radii_per_s,"
        "mean_over_wanted,reference_change_radii_per_s,run_evaluations,trial_evaluations,evaluations,seconds";
    for (const char* unit : {"evaluations", "seconds"})
        csv += fmt::format(
            ",best_{0}_stepper,best_{0}_step_s,best_{0}_its_evaluations,best_{0}_its_seconds,{0}_over_best", unit);
    csv += "\n";
    for (const WholeScene& scene : scenes)
        csv +=
            fmt::format("{},{},{}\n",
                        csvFields(scene.name, scene.particles, scene.duration, scene.windows.size(), scene.wanted,
                                  scene.meanError, scene.largestError, scene.meanError / scene.wanted, scene.change,
                                  scene.runEvaluations, scene.trialEvaluations, scene.evaluationCost(), scene.seconds),
                        comparison(scene, &FixedWholeRun::evaluationCost, scene.evaluationCost()),
                        comparison(scene, &FixedWholeRun::seconds, scene.seconds));
    return csv;
}

std::string wholeSteppersCsv(const std::vector<WholeScene>& scenes) {
    std::string csv = "scene,stepper,step_s,error_radii_per_s,evaluations,seconds\n";
    for (const WholeScene& scene : scenes)
        for (const FixedWholeRun& run : scene.fixed)
            csv += csvFields(scene.name, engine::nameOf(run.stepper), run.step, run.error, run.evaluationCost,
                             run.seconds) +
                   "\n";
    return csv;
}

std::string wholeLadderCsv(const std::vector<WholeScene>& scenes) {
    std::string csv = "scene,stepper,step_s,error_radii_per_s,evaluations_in_windows,rejected_share\n";
    for (const WholeScene& scene : scenes)
        for (const auto& [stepper, point] : scene.ladder)
            csv += csvFields(scene.name, engine::nameOf(stepper), point.step,
                             std::isfinite(point.error) ? std::optional(point.error) : std::nullopt, point.evaluations,
                             point.rejected) +
                   "\n";
    return csv;
}

std::string wholeWindowsCsv(const std::vector<WholeScene>& scenes) {
    std::string csv = "scene,from_s,mean_step_s,error_radii_per_s,reference_change_radii_per_s\n";
    for (const WholeScene& scene : scenes)
        for (const WholeWindowError& window : scene.windows)
            csv += csvFields(scene.name, window.from, window.meanStep, window.error, window.change) + "\n";
    return csv;
}

std::string wholeSentence(const std::vector<WholeScene>& scenes) {
    double evaluations = 0.0, seconds = 0.0, least = 0.0, most = 0.0;
    for (const WholeScene& scene : scenes) {
        if (const auto best = bestBy(scene.fixed, &FixedWholeRun::evaluationCost))
            evaluations = std::max(evaluations, scene.evaluationCost() / best->evaluationCost);
        if (const auto best = bestBy(scene.fixed, &FixedWholeRun::seconds))
            seconds = std::max(seconds, scene.seconds / best->seconds);
        const double ratio = scene.meanError / scene.wanted;
        least = &scene == &scenes.front() ? ratio : std::min(least, ratio);
        most = std::max(most, ratio);
    }
    return fmt::format(
        "Over whole scenes, its trial runs included, the automatic stepper spends at most {:.2f} times the force "
        "evaluations of the best fixed stepper and step that meet the error, and at most {:.2f} times its seconds; its "
        "measured error is {:.2f} to {:.2f} times the wanted one.",
        evaluations, seconds, least, most);
}

}  // namespace studies
