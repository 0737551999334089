// What the study of scaling writes: tables and the script of the plot.
#include <fmt/format.h>

#include "studies/common/curves.h"
#include "studies/scaling/scaling.h"

namespace studies {
namespace {

std::string milliseconds(const std::optional<double>& seconds) {
    return seconds ? fmt::format("{:.5g}", 1e3 * *seconds) : "";
}

constexpr const char* kAxes = R"(set format x "10^{%L}"
set format y "10^{%L}"
set xlabel "particles"
set ylabel "milliseconds a step"
set title "Time per step against the number of particles"
set key top left reverse Left samplen 2 font ",13"
)";

void addPoint(Curve& curve, const ScalingRow& row, const std::optional<double>& seconds) {
    if (seconds) curve.points += fmt::format("{} {:.6g}\n", row.particles, 1e3 * *seconds);
}

}  // namespace

std::string scalingCsv(const std::vector<ScalingRow>& rows) {
    std::string csv = "subject,particles,neighbors,published_ms,every_pair_ms,list_ms,list_in_float_ms,state_hash\n";
    for (const ScalingRow& row : rows)
        csv += fmt::format("{},{},{:.4g},{},{},{},{},{}\n", row.subject, row.particles, row.neighbors,
                           milliseconds(row.published), milliseconds(row.everyPair), milliseconds(row.list),
                           milliseconds(row.listInFloat), row.stateHash);
    return csv;
}

std::string fitsCsv(const std::vector<ScalingFit>& fits) {
    std::string csv = "subject,method,from,to,exponent\n";
    for (const ScalingFit& fit : fits)
        csv += fmt::format("{},{},{},{},{:.3f}\n", fit.subject, fit.method, fit.from, fit.to, fit.exponent);
    return csv;
}

std::string scalingPlot(const std::vector<ScalingRow>& rows) {
    Curve published{"Table 2 (the paper's machine)", "lines linewidth 2 linecolor rgb '#7f7f7f' dashtype 2", ""};
    Curve everyPair{"every pair, here", "linespoints pointtype 5 pointsize 0.7 linecolor rgb '#d62728'", ""};
    Curve list{"neighbor lists", "linespoints pointtype 7 pointsize 0.8 linecolor rgb '#0072b2'", ""};
    Curve inFloat{"neighbor lists in float", "linespoints pointtype 6 pointsize 1 linecolor rgb '#56b4e9'", ""};
    std::string subject;
    for (const ScalingRow& row : rows) {
        // An empty line ends a line of points: those of one scene or material belong together.
        if (!subject.empty() && row.subject != subject)
            for (Curve* curve : {&everyPair, &list, &inFloat}) curve->points += "\n";
        subject = row.subject;
        if (row.published && row.subject == rows.front().subject) addPoint(published, row, row.published);
        addPoint(everyPair, row, row.everyPair);
        addPoint(list, row, row.list);
        addPoint(inFloat, row, row.listInFloat);
    }
    return std::string(kPlotFrame) + kAxes + plotOf({published, everyPair, list, inFloat});
}

}  // namespace studies
