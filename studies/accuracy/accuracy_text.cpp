// The results of the study of accuracy as text: CSV tables and gnuplot scripts of plots. See accuracy.h.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/stepping/take_step.h"
#include "studies/accuracy/accuracy.h"
#include "studies/common/report.h"

namespace studies {
namespace {

/// A value for a CSV field, which stays empty unless the condition holds.
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

/// Three CSV fields: the best fixed stepper, its cost, and the automatic stepper's cost over it; empty without one.
std::string comparison(const std::optional<HandPicked>& picked, double cost) {
    if (!picked) return ",,";
    return csvFields(engine::nameOf(picked->stepper), picked->cost, cost / picked->cost);
}

/// How the curve of a stepper's runs is drawn in the plot.
struct CurveStyle {
    Variant variant;
    const char* color;
    int pointType;  ///< gnuplot's number of the symbol
    double pointSize;
    double lineWidth;
};

/// How the curves of all steppers are drawn. The colors are those of Okabe and Ito's palette, which color-blind readers
/// can tell apart. The automatic stepper is drawn last, over the others.
const std::array kCurveStyles = {
    CurveStyle{{engine::StepperKind::symplecticEuler, 0.0, {}}, "#7f7f7f", 5, 0.7, 1.6},
    CurveStyle{{engine::StepperKind::velocityVerlet, 0.0, {}}, "#0072b2", 7, 0.8, 1.8},
    CurveStyle{{engine::StepperKind::leapfrog, 0.0, {}}, "#cc79a7", 4, 0.8, 1.4},
    CurveStyle{{engine::StepperKind::implicitDamping, 0.0, {}}, "#009e73", 9, 1.0, 1.8},
    CurveStyle{{engine::StepperKind::linearlyImplicit, 0.0, {}}, "#e69f00", 11, 1.0, 1.8},
    CurveStyle{{engine::StepperKind::velocityVerlet, 0.0, {}, engine::Precision::singles}, "#56b4e9", 6, 1.0, 1.2},
    CurveStyle{{engine::StepperKind::automatic, 0.0, {}}, "#d62728", 13, 1.2, 2.6}};

/// Errors above this many radii say only that a run is useless, so the plot does not extend to them.
constexpr double kUselessError = 10.0;

constexpr const char* kKey = R"(set format y "10^{%L}"
set key at screen 0.5, screen 0.02 center bottom horizontal reverse Left samplen 2 font ",13"
set bmargin 8
)";

double costOf(const AccuracyRow& row, CostAxis axis) {
    return axis == CostAxis::seconds ? row.run.seconds : row.run.evaluationCost;
}

Curve curveOf(const SceneAccuracy& scene, const CurveStyle& style, CostAxis axis) {
    Curve curve{nameOf(style.variant),
                fmt::format("linespoints linecolor rgb \"{}\" linewidth {} pointtype {} pointsize {}", style.color,
                            style.lineWidth, style.pointType, style.pointSize)};
    int unfinished = 0;
    for (const AccuracyRow& row : scene.rows) {
        if (!isOf(row.run.variant, style.variant.stepper, style.variant.precision)) continue;
        if (row.run.ending != Ending::finished) ++unfinished;
        if (row.resolved) curve.points += fmt::format("{:.6g} {:.6g}\n", costOf(row, axis), row.error);
    }
    if (unfinished > 0) curve.title += fmt::format(" ({} failed)", unfinished);
    return curve;
}

/// A text in single quotes for gnuplot: quotes inside are doubled, line ends become spaces, all else is literal.
std::string quoted(const std::string& text) {
    std::string result = "'";
    for (const char c : text) result += c == '\'' ? std::string("''") : std::string(1, c == '\n' ? ' ' : c);
    return result + "'";
}

std::string axes(const SceneAccuracy& scene, CostAxis axis) {
    const std::string window =
        fmt::format("{} particles, {:g} s of motion from {:.3g} s on", scene.particleCount, scene.window, scene.from);
    return fmt::format(
        "set title {} . \"\\n\" . {} noenhanced\nset xlabel \"{}\"\nset ylabel \"{}\"\n", quoted(scene.title),
        quoted(window),
        axis == CostAxis::seconds
            ? std::string("wall-clock seconds")
            : fmt::format("force evaluations (a product of the implicit steppers counts {})", scene.productCost),
        scene.reference.metric == ErrorMetric::positions
            ? "rms position error at the end (radii)"
            : "largest error of center, gyration, R90, z90 at the end (radii)");
}

/// Ticks of the cost axis: at 1, 2 and 5 times every power of ten, because costs often span less than a decade.
std::string ticks(double least, double most) {
    std::string list;
    for (double decade = std::pow(10.0, std::floor(std::log10(least))); decade <= most; decade *= 10.0)
        for (const double digit : {1.0, 2.0, 5.0})
            if (digit * decade >= least && digit * decade <= most)
                list += fmt::format("{}{:.6g}", list.empty() ? "" : ", ", digit * decade);
    return list;
}

/// gnuplot commands for the ranges of both axes, which leave some room around the outermost points.
std::string ranges(const SceneAccuracy& scene, CostAxis axis) {
    std::vector<double> costs, errors;
    for (const AccuracyRow& row : scene.rows) {
        if (!row.resolved || row.error > kUselessError) continue;
        costs.push_back(costOf(row, axis));
        errors.push_back(row.error);
    }
    if (costs.empty()) costs = errors = {1.0};
    const double leastCost = std::ranges::min(costs) / 1.3;
    const double mostCost = std::ranges::max(costs) * 1.5;
    return fmt::format("set xrange [{:.6g}:{:.6g}]\nset yrange [{:.6g}:{:.6g}]\nset xtics ({})\n", leastCost, mostCost,
                       std::ranges::min(errors) / 1.5, std::ranges::max(errors) * 1.5, ticks(leastCost, mostCost));
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

std::string accuracyPlot(const SceneAccuracy& scene, CostAxis axis) {
    std::vector<Curve> curves;
    for (const CurveStyle& style : kCurveStyles) curves.push_back(curveOf(scene, style, axis));
    return plotScript(kKey + axes(scene, axis) + ranges(scene, axis), curves);
}

}  // namespace studies
