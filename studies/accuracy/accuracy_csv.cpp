// The tables of the accuracy study as CSV, see accuracy.h.
#include "studies/accuracy/accuracy.h"

#include <fmt/format.h>

#include <cmath>

#include "engine/stepping/steppers.h"
#include "studies/common/report.h"

namespace studies {
namespace {

std::string number(double value) {
    return fmt::format("{:.6g}", value);
}

std::string errorsOf(const SceneAccuracy& scene, const AccuracyRow& row) {
    if (row.run.ending != Ending::finished) return fmt::format(",,,,{},,no", nameOf(scene.reference.metric));
    const bool isCompared = row.compared > 0;
    return fmt::format("{},{},{},{},{},{},{}", isCompared ? number(row.rms) : "", isCompared ? number(row.largest) : "",
                       row.compared, number(row.statistics), nameOf(scene.reference.metric),
                       std::isfinite(row.errorPerSecond) ? number(row.errorPerSecond) : "",
                       row.resolved ? "yes" : "no");
}

std::string driftsOf(const AccuracyRow& row) {
    if (row.run.ending != Ending::finished) return ",,";
    return fmt::format("{},{},{}", number(row.energyDrift), number(row.linearDrift), number(row.angularDrift));
}

std::string lineOf(const SceneAccuracy& scene, const AccuracyRow& row) {
    const WindowRun& run = row.run;
    const bool automatic = run.variant.stepper == engine::StepperKind::automatic;
    const engine::StepStatistics& steps = run.steps;
    return fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n", csvField(scene.name), nameOf(run.variant),
                       automatic ? "" : number(run.variant.asked), automatic ? number(run.variant.asked) : "",
                       nameOf(run.ending), errorsOf(scene, row), number(run.seconds), steps.count,
                       number(steps.shortest), number(steps.longest), steps.forceEvaluations, steps.products,
                       number(run.errorEstimateCost), steps.rejected, driftsOf(row));
}

/// Three fields: the fixed stepper, its cost, and the automatic stepper's cost over it.
std::string against(const std::optional<HandPicked>& picked, double cost) {
    if (!picked) return ",,";
    return fmt::format("{},{},{}", engine::nameOf(picked->stepper), number(picked->cost), number(cost / picked->cost));
}

}  // namespace

std::string accuracyCsv(const std::vector<SceneAccuracy>& scenes) {
    std::string csv =
        "scene,stepper,step_s,asked_radii_per_s,ending,rms_error_radii,largest_error_radii,particles_compared,"
        "statistics_error_radii,measure,error_radii_per_s,resolved,seconds,steps,shortest_step_s,longest_step_s,"
        "force_evaluations,products,error_estimate_evaluations,rejected,energy_drift,linear_momentum_drift,angular_"
        "momentum_drift\n";
    for (const SceneAccuracy& scene : scenes)
        for (const AccuracyRow& row : scene.rows) csv += lineOf(scene, row);
    return csv;
}

std::string ordersCsv(const std::vector<SceneAccuracy>& scenes) {
    std::string csv = "scene,stepper,order,expected,points,longest_step_s,shortest_step_s\n";
    for (const SceneAccuracy& scene : scenes)
        for (const OrderRow& row : scene.orders)
            csv += fmt::format("{},{},{},{},{},{},{}\n", csvField(scene.name), engine::nameOf(row.stepper),
                               row.order ? number(*row.order) : "", engine::orderOf(row.stepper), row.points,
                               row.points == 0 ? "" : number(row.longest), row.points == 0 ? "" : number(row.shortest));
    return csv;
}

std::string autosCsv(const std::vector<SceneAccuracy>& scenes) {
    std::string csv = "scene,asked_radii_per_s,obtained_radii_per_s,obtained_over_asked,resolved,seconds,evaluations";
    for (const char* unit : {"seconds", "evaluations"})
        for (const char* at : {"obtained", "asked"})
            csv += fmt::format(",best_{0}_stepper_at_{1},best_{0}_at_{1},{0}_over_best_at_{1}", unit, at);
    csv += "\n";
    for (const SceneAccuracy& scene : scenes)
        for (const AutoRow& row : scene.autos)
            csv += fmt::format("{},{},{},{},{},{},{},{},{},{},{}\n", csvField(scene.name), number(row.asked),
                               number(row.obtained), number(row.obtained / row.asked), row.resolved ? "yes" : "no",
                               number(row.seconds), number(row.evaluationCost),
                               against(row.secondsAtObtained, row.seconds), against(row.secondsAtAsked, row.seconds),
                               against(row.evaluationsAtObtained, row.evaluationCost),
                               against(row.evaluationsAtAsked, row.evaluationCost));
    return csv;
}

std::string referencesCsv(const std::vector<SceneAccuracy>& scenes) {
    std::string csv =
        "scene,particles,from_s,window_s,measure,stepper,step_s,change_by_halving_radii,twin_separation_radii,"
        "births_differ,resolution_radii,settled,seconds\n";
    for (const SceneAccuracy& scene : scenes) {
        const ReferenceFacts& facts = scene.reference;
        csv += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{}\n", csvField(scene.name), scene.particleCount,
                           number(scene.from), number(scene.window), nameOf(facts.metric),
                           engine::nameOf(facts.variant.stepper), number(facts.variant.asked), number(facts.change),
                           number(facts.twinSeparation), facts.birthsDiffer ? "yes" : "no", number(facts.resolution),
                           facts.settled ? "yes" : "no", number(facts.seconds));
    }
    return csv;
}

}  // namespace studies
