// The tables of the accuracy study as CSV, see accuracy.h.
#include <cmath>

#include "engine/stepping/steppers.h"
#include "studies/accuracy/accuracy.h"
#include "studies/common/report.h"

namespace studies {
namespace {

/// The value if the condition holds, else an empty field.
template <typename T>
std::optional<T> fieldIf(bool condition, const T& value) {
    return condition ? std::optional<T>(value) : std::nullopt;
}

std::string fieldsOf(const SceneAccuracy& scene, const AccuracyRow& row) {
    const WindowRun& run = row.run;
    const engine::StepStatistics& steps = run.steps;
    const bool isAutomatic = run.variant.stepper == engine::StepperKind::automatic;
    const bool isFinished = run.ending == Ending::finished;
    const bool isCompared = isFinished && row.compared > 0;
    return csvFields(scene.name, nameOf(run.variant), fieldIf(!isAutomatic, run.variant.asked),
                     fieldIf(isAutomatic, run.variant.asked), nameOf(run.ending), fieldIf(isCompared, row.rms),
                     fieldIf(isCompared, row.largest), fieldIf(isFinished, row.compared),
                     fieldIf(isFinished, row.statistics), nameOf(scene.reference.metric),
                     fieldIf(isFinished && std::isfinite(row.errorPerSecond), row.errorPerSecond), row.resolved,
                     run.seconds, steps.count, steps.shortest, steps.longest, steps.forceEvaluations, steps.products,
                     run.errorEstimateCost, steps.rejected, fieldIf(isFinished, row.energyDrift),
                     fieldIf(isFinished, row.linearDrift), fieldIf(isFinished, row.angularDrift));
}

/// Three fields: the fixed stepper, its cost, and the automatic stepper's cost over it; empty if there is none.
std::string comparison(const std::optional<HandPicked>& picked, double cost) {
    if (!picked) return ",,";
    return csvFields(engine::nameOf(picked->stepper), picked->cost, cost / picked->cost);
}

}  // namespace

std::string accuracyCsv(const std::vector<SceneAccuracy>& scenes) {
    std::string csv =
        "scene,stepper,step_s,asked_radii_per_s,ending,rms_error_radii,largest_error_radii,particles_compared,"
        "statistics_error_radii,measure,error_radii_per_s,resolved,seconds,steps,shortest_step_s,longest_step_s,"
        "force_evaluations,products,error_estimate_evaluations,rejected,energy_drift,linear_momentum_drift,"
        "angular_momentum_drift\n";
    for (const SceneAccuracy& scene : scenes)
        for (const AccuracyRow& row : scene.rows) csv += fieldsOf(scene, row) + "\n";
    return csv;
}

std::string ordersCsv(const std::vector<SceneAccuracy>& scenes) {
    std::string csv = "scene,stepper,order,expected,points,longest_step_s,shortest_step_s\n";
    for (const SceneAccuracy& scene : scenes)
        for (const OrderRow& row : scene.orders)
            csv += csvFields(scene.name, engine::nameOf(row.stepper), row.order, engine::orderOf(row.stepper),
                             row.points, fieldIf(row.points > 0, row.longest), fieldIf(row.points > 0, row.shortest)) +
                   "\n";
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
            csv +=
                fmt::format("{},{},{},{},{}\n",
                            csvFields(scene.name, row.asked, row.obtained, row.obtained / row.asked, row.resolved,
                                      row.seconds, row.evaluationCost),
                            comparison(row.secondsAtObtained, row.seconds), comparison(row.secondsAtAsked, row.seconds),
                            comparison(row.evaluationsAtObtained, row.evaluationCost),
                            comparison(row.evaluationsAtAsked, row.evaluationCost));
    return csv;
}

std::string referencesCsv(const std::vector<SceneAccuracy>& scenes) {
    std::string csv =
        "scene,particles,from_s,window_s,measure,stepper,step_s,change_by_halving_radii,twin_separation_radii,"
        "births_differ,resolution_radii,settled,seconds\n";
    for (const SceneAccuracy& scene : scenes) {
        const ReferenceFacts& facts = scene.reference;
        csv += csvFields(scene.name, scene.particleCount, scene.from, scene.window, nameOf(facts.metric),
                         engine::nameOf(facts.variant.stepper), facts.variant.asked, facts.change, facts.twinSeparation,
                         facts.birthsDiffer, facts.resolution, facts.settled, facts.seconds) +
               "\n";
    }
    return csv;
}

}  // namespace studies
