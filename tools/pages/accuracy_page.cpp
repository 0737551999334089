// HTML by hand: a head, a section for each scene, a table for each question.
#include "tools/pages/accuracy_page.h"

#include <fmt/format.h>

#include <cmath>

#include "engine/stepping/steppers.h"
#include "tools/pages/html.h"

namespace tools {
namespace {

using studies::Ending;

constexpr const char* kHead = R"(<!doctype html>
<html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width">
<title>Globular dynamics: speed against error</title>
<style>
body { font: 16px/1.5 system-ui, sans-serif; margin: 0 auto; max-width: 84rem; padding: 2rem 1rem; color: #222; background: #f6f6f4; }
section { background: #fff; border: 1px solid #ddd; border-radius: 6px; margin: 2rem 0; padding: 1rem 1.5rem; overflow-x: auto; }
.plots { display: flex; flex-wrap: wrap; gap: 1rem; }
.plots img { flex: 1 1 24rem; min-width: 0; max-width: 100%; }
table { border-collapse: collapse; font-size: 0.85rem; font-variant-numeric: tabular-nums; margin: 0.5rem 0 1rem; }
th { text-align: left; font-weight: 600; vertical-align: bottom; }
td, th { border-top: 1px solid #eee; padding: 0.1rem 0.9rem 0.1rem 0; }
code { background: #f0f0ec; padding: 0 0.2rem; }
</style></head><body>
<h1>Speed against error</h1>
)";

std::string small(double value) {
    return fmt::format("{:.2e}", value);
}

std::string nameIn(const studies::WindowRun& run) {
    return nameOf(run.variant);
}

std::string askedOf(const studies::Variant& variant) {
    return variant.stepper == engine::StepperKind::automatic ? fmt::format("{:g} radii/s", variant.asked)
                                                             : fmt::format("{:.4g} ms", 1000.0 * variant.asked);
}

std::string remarkOn(const studies::AccuracyRow& row) {
    if (row.resolved) return "";
    return std::isfinite(row.error) ? "below resolution" : "other births";
}

Cells cellsOf(const studies::AccuracyRow& row) {
    const studies::WindowRun& run = row.run;
    const engine::StepStatistics& steps = run.steps;
    Cells cells = {nameIn(run), askedOf(run.variant)};
    if (run.ending == Ending::finished)
        cells.insert(cells.end(), {row.compared > 0 ? small(row.rms) : "", row.compared > 0 ? small(row.largest) : "",
                                   fmt::format("{}", row.compared), small(row.statistics),
                                   std::isfinite(row.error) ? small(row.errorPerSecond) : "", remarkOn(row)});
    else
        cells.insert(cells.end(), {"", "", "", "", "", studies::nameOf(run.ending)});
    cells.insert(cells.end(), {fmt::format("{:.3g}", run.seconds), fmt::format("{}", steps.count),
                               fmt::format("{}", steps.forceEvaluations), fmt::format("{}", steps.products),
                               fmt::format("{:.0f}", run.errorEstimateCost), fmt::format("{}", steps.rejected)});
    if (run.ending == Ending::finished)
        cells.insert(cells.end(), {small(row.energyDrift), small(row.linearDrift), small(row.angularDrift)});
    return cells;
}

std::string runTable(const studies::SceneAccuracy& accuracy) {
    std::vector<Cells> rows;
    for (const studies::AccuracyRow& row : accuracy.rows) rows.push_back(cellsOf(row));
    return table({"stepper", "asked", "rms error (radii)", "largest (radii)", "particles compared",
                  "statistics (radii)", "error per second", "", "seconds", "steps", "force evaluations", "products",
                  "error estimates", "taken back", "energy drift", "momentum drift", "angular drift"},
                 rows);
}

std::string orderTable(const studies::SceneAccuracy& accuracy) {
    std::vector<Cells> rows;
    for (const studies::OrderRow& row : accuracy.orders)
        rows.push_back({std::string(engine::nameOf(row.stepper)),
                        row.order ? fmt::format("{:.2f}", *row.order) : "too few points",
                        fmt::format("{}", engine::orderOf(row.stepper)),
                        row.points == 0 ? ""
                                        : fmt::format("{} runs, {:.4g} to {:.4g} ms", row.points, 1000.0 * row.longest,
                                                      1000.0 * row.shortest)});
    return table({"stepper", "order measured", "expected", "from"}, rows);
}

std::string against(const std::optional<studies::HandPicked>& picked, double cost) {
    if (!picked) return "none errs as little";
    return fmt::format("{:.2f} \u00d7 {}", cost / picked->cost, engine::nameOf(picked->stepper));
}

std::string autoTable(const studies::SceneAccuracy& accuracy) {
    std::vector<Cells> rows;
    for (const studies::AutoRow& row : accuracy.autos)
        rows.push_back({fmt::format("{:g}", row.asked), small(row.obtained),
                        fmt::format("{:.2f}{}", row.obtained / row.asked, row.resolved ? "" : " or less"),
                        fmt::format("{:.3g}", row.seconds), against(row.secondsAtObtained, row.seconds),
                        against(row.secondsAtAsked, row.seconds),
                        against(row.evaluationsAtObtained, row.evaluationCost),
                        against(row.evaluationsAtAsked, row.evaluationCost)});
    return table(
        {"asked (radii/s)", "obtained (radii/s)", "ratio", "seconds", "seconds over best, at the error obtained",
         "at the error asked", "force evaluations over best, at the error obtained", "at the error asked"},
        rows);
}

std::string referenceText(const studies::SceneAccuracy& accuracy) {
    const studies::ReferenceFacts& facts = accuracy.reference;
    return fmt::format(
        "<p>{} particles, {:g} s of motion from {:.4g} s on; every run starts from the same state. Reference: {} at "
        "{:.4g} &micro;s, {:.3g} s; the last halving of its step changed it by {:.1e} radii{}. Errors below {:.1e} "
        "radii are not told from its own. Twins that begin 1e-9 radii apart end {:.1e} radii apart{}: errors are "
        "measured in {}.</p>\n",
        accuracy.particleCount, accuracy.window, accuracy.from, engine::nameOf(facts.variant.stepper),
        1e6 * facts.variant.asked, facts.seconds, facts.change,
        facts.settled ? "" : ", more than a twentieth of the smallest error (budget spent)", facts.resolution,
        facts.twinSeparation, facts.birthsDiffer ? ", and even the finest runs have other births" : "",
        studies::nameOf(facts.measure));
}

std::string section(const AccuracySection& section) {
    const studies::SceneAccuracy& accuracy = section.accuracy;
    return fmt::format("<section><h2>{}: {}</h2>\n", escaped(accuracy.name), escaped(accuracy.title)) +
           referenceText(accuracy) + "<div class=\"plots\">\n" + picture("error against seconds", section.secondsPlot) +
           picture("error against force evaluations", section.evaluationsPlot) +
           "</div>\n<h3>auto against the best hand-picked stepper and step</h3>\n" + autoTable(accuracy) +
           "<h3>Orders</h3>\n" + orderTable(accuracy) + "<details><summary>All runs</summary>\n" + runTable(accuracy) +
           "</details></section>\n";
}

std::string introduction(const StudyRun& facts) {
    return fmt::format(
        "<p><code>{}</code>, {} thread{}. Seconds are wall clock, {}. Costs in force evaluations include the implicit "
        "steppers' matrix-vector products, each at the share of an evaluation that the plots state, and the automatic "
        "stepper's error estimates within the window. The automatic stepper begins the window with its choice made, "
        "as in the middle of a run: its first error estimates are not counted, nor is the comparison of all steppers "
        "at every fifth estimate, some dozens of intervals apart, which so short a window seldom contains. The cost of "
        "a hand-picked "
        "stepper at an error is read off its line in the plot, log-linear between its points; the "
        "best is the cheapest of all fixed steppers. Drifts are differences from the reference at the end: of the "
        "energy, over the reference's kinetic energy and the sizes of its pair and contact energies; of the momenta, "
        "over its sum of |p| and of |x &times; p|. The same numbers are in accuracy.csv, orders.csv, auto.csv and "
        "references.csv.</p>\n",
        escaped(facts.command), facts.threads, facts.threads == 1 ? "" : "s",
        facts.isTimedOnce ? "each run timed once"
                          : "the least of three rounds for runs below 5 s, of up to twelve for short ones");
}

}  // namespace

std::string accuracyPage(const std::vector<AccuracySection>& sections, const StudyRun& facts) {
    std::string html = kHead + introduction(facts);
    for (const AccuracySection& each : sections) html += section(each);
    return html + "</body></html>\n";
}

}  // namespace tools
