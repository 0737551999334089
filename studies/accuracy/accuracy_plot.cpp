// Points to data blocks, one plot command over them.
#include "studies/accuracy/accuracy_plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "engine/stepping/steppers.h"

namespace studies {
namespace {

/// Colors of Okabe and Ito's palette, which stay apart for color-blind eyes; the automatic stepper is drawn over the
/// others.
struct Mark {
    Variant variant;
    const char* color;
    int point;
    double size;
    double width;
};

const std::array kMarks = {
    Mark{{engine::StepperKind::symplecticEuler, 0.0, {}}, "#7f7f7f", 5, 0.7, 1.6},
    Mark{{engine::StepperKind::velocityVerlet, 0.0, {}}, "#0072b2", 7, 0.8, 1.8},
    Mark{{engine::StepperKind::leapfrog, 0.0, {}}, "#cc79a7", 4, 0.8, 1.4},
    Mark{{engine::StepperKind::implicitDamping, 0.0, {}}, "#009e73", 9, 1.0, 1.8},
    Mark{{engine::StepperKind::linearlyImplicit, 0.0, {}}, "#e69f00", 11, 1.0, 1.8},
    Mark{{engine::StepperKind::velocityVerlet, 0.0, {}, engine::Precision::singles}, "#56b4e9", 6, 1.0, 1.2},
    Mark{{engine::StepperKind::automatic, 0.0, {}}, "#d62728", 13, 1.2, 2.6}};

/// Beyond it nothing is left to tell apart, radii; lines lead out of the frame toward such runs.
constexpr double kMeaningless = 10.0;

constexpr const char* kFrame = R"(set terminal svg size 860,600 enhanced font "DejaVu Sans,15" background "white"
set logscale xy
set format y "10^{%L}"
set grid xtics ytics mxtics mytics linewidth 1 linecolor rgb "#d9d9d9", linewidth 0.5 linecolor rgb "#eeeeee"
set border linecolor rgb "#444444"
set key at screen 0.5, screen 0.02 center bottom horizontal reverse Left samplen 2 font ",13"
set bmargin 8
set lmargin 11
)";

double costOf(const AccuracyRow& row, CostAxis axis) {
    return axis == CostAxis::seconds ? row.run.seconds : row.run.evaluationCost;
}

/// Cost, error, what was asked.
std::string pointsOf(const SceneAccuracy& scene, const Variant& variant, CostAxis axis) {
    std::string points;
    for (const AccuracyRow& row : scene.rows)
        if (isOf(row.run.variant, variant.stepper, variant.precision) && row.resolved)
            points += fmt::format("{:.6g} {:.6g} {:g}\n", costOf(row, axis), row.error, row.run.variant.asked);
    return points;
}

std::string keyOf(const SceneAccuracy& scene, const Variant& variant) {
    const auto unfinished = std::count_if(scene.rows.begin(), scene.rows.end(), [&](const AccuracyRow& row) {
        return isOf(row.run.variant, variant.stepper, variant.precision) && row.run.ending != Ending::finished;
    });
    return unfinished == 0 ? nameOf(variant) : fmt::format("{} ({} failed)", nameOf(variant), unfinished);
}

/// Inside gnuplot's single quotes a quote is doubled and everything else stands for itself, but the line must not end.
std::string quoted(const std::string& text) {
    std::string result = "'";
    for (const char c : text) result += c == '\'' ? std::string("''") : std::string(1, c == '\n' ? ' ' : c);
    return result + "'";
}

std::string axes(const SceneAccuracy& scene, CostAxis axis) {
    const bool positions = scene.reference.measure == ErrorMetric::positions;
    const std::string what =
        fmt::format("{} particles, {:g} s of motion from {:.3g} s on", scene.particleCount, scene.window, scene.from);
    return fmt::format(
        "set title {} . \"\\n\" . {} noenhanced\nset xlabel \"{}\"\nset ylabel \"{}\"\n", quoted(scene.title),
        quoted(what),
        axis == CostAxis::seconds
            ? std::string("wall-clock seconds")
            : fmt::format("force evaluations (a product of the implicit steppers counts {})", scene.productCost),
        positions ? "rms position error at the end (radii)"
                  : "largest error of center, gyration, R90, z90 at the end (radii)");
}

struct Span {
    double least = std::numeric_limits<double>::infinity();
    double most = 0.0;

    void hold(double value) {
        least = std::min(least, value);
        most = std::max(most, value);
    }
};

/// Ticks at 1, 2 and 5 of every decade within the span, because a span of costs is often shorter than a decade.
std::string ticks(const Span& span) {
    std::string list;
    for (double decade = std::pow(10.0, std::floor(std::log10(span.least))); decade <= span.most; decade *= 10.0)
        for (const double digit : {1.0, 2.0, 5.0})
            if (digit * decade >= span.least && digit * decade <= span.most)
                list += fmt::format("{}{:.6g}", list.empty() ? "" : ", ", digit * decade);
    return list;
}

/// Ranges with room for the points at the edge and their labels.
std::string ranges(const SceneAccuracy& scene, CostAxis axis) {
    Span costs;
    Span errors;
    for (const AccuracyRow& row : scene.rows) {
        if (!row.resolved || row.error > kMeaningless) continue;
        costs.hold(costOf(row, axis));
        errors.hold(row.error);
    }
    if (costs.most == 0.0) costs = errors = {1.0, 1.0};
    const Span wide{costs.least / 1.3, costs.most * 1.5};
    return fmt::format("set xrange [{:.6g}:{:.6g}]\nset yrange [{:.6g}:{:.6g}]\nset xtics ({})\n", wide.least,
                       wide.most, errors.least / 1.5, errors.most * 1.5, ticks(wide));
}

std::string plotCommand(const std::vector<std::string>& curves) {
    if (curves.empty()) return "plot 1 notitle linecolor rgb \"white\"\n";
    std::string command = "plot ";
    for (std::size_t k = 0; k < curves.size(); ++k) command += (k == 0 ? "" : ", \\\n     ") + curves[k];
    return command + "\n";
}

}  // namespace

std::string plotScript(const SceneAccuracy& scene, CostAxis axis) {
    std::string data;
    std::vector<std::string> curves;
    for (const Mark& mark : kMarks) {
        const std::string points = pointsOf(scene, mark.variant, axis);
        if (points.empty()) continue;
        const std::string block = fmt::format("$curve{}", curves.size());
        data += fmt::format("{} << EOD\n{}EOD\n", block, points);
        curves.push_back(fmt::format(
            "{} using 1:2 with linespoints linecolor rgb \"{}\" linewidth {} pointtype {} pointsize {} title \"{}\"",
            block, mark.color, mark.width, mark.point, mark.size, keyOf(scene, mark.variant)));
        if (mark.variant.stepper == engine::StepperKind::automatic)
            curves.push_back(
                fmt::format("{} using 1:2:(sprintf(\"%g\", $3)) with labels offset 1.2,0.6 left "
                            "font \",12\" textcolor rgb \"{}\" notitle",
                            block, mark.color));
    }
    return kFrame + axes(scene, axis) + ranges(scene, axis) + data + plotCommand(curves);
}

}  // namespace studies
