// HTML by hand: the table of the cases, then the variants of each.
#include "tools/pages/stability_page.h"

#include <fmt/format.h>

#include "studies/stability/stability_text.h"
#include "tools/pages/html.h"

namespace tools {
namespace {

constexpr const char* kHead = R"(<!doctype html>
<html lang="en"><head><meta charset="utf-8"><meta name="viewport" content="width=device-width">
<title>globular: the hard cases</title>
<style>
body { font: 16px/1.5 system-ui, sans-serif; margin: 0 auto; max-width: 84rem; padding: 2rem 1rem; color: #222; background: #f6f6f4; }
table { border-collapse: collapse; font-size: 0.85rem; background: #fff; font-variant-numeric: tabular-nums; }
th, td { border: 1px solid #ddd; padding: 0.2rem 0.7rem; text-align: left; vertical-align: top; }
th { background: #eee; }
.bad { background: #fbe0dc; }
code { background: #f0f0ec; padding: 0 0.2rem; }
</style></head><body>
<h1>globular: the hard cases</h1>
)";

std::string cell(const std::string& text, bool isBad = false) {
    return fmt::format("<td{}>{}</td>", isBad ? " class=\"bad\"" : "", escaped(text));
}

std::string summaryTable(const std::vector<studies::CaseResult>& results) {
    std::string html = "<table>\n<tr>";
    for (const char* column : studies::kStabilityColumns) html += fmt::format("<th>{}</th>", escaped(column));
    html += "</tr>\n";
    for (const studies::CaseResult& result : results) {
        const bool isBad = !studies::oursPasses(result) || !studies::paperIsAsExpected(result);
        html += "<tr>";
        for (const std::string& text : studies::rowOf(result)) html += cell(text, isBad);
        html += "</tr>\n";
    }
    return html + "</table>\n";
}

std::string variantRow(const studies::VariantResult& variant) {
    const studies::Outcome& ours = variant.ours;
    return fmt::format("<tr>{}{}{}{}{}{}{}{}{}</tr>\n", cell(variant.changes.empty() ? "as it is" : variant.changes),
                       cell(std::string(scenes::infoOf(variant.study.observable).name)),
                       cell(studies::outcomeText(variant.paper)),
                       cell(fmt::format("{}: {}", ours.stepper, studies::outcomeText(ours)), !ours.passes),
                       cell(studies::limitText(variant.study)), cell(fmt::format("{}", ours.particles)),
                       cell(fmt::format("{}", ours.steps.count)), cell(fmt::format("{}", ours.steps.rejected)),
                       cell(fmt::format("{:.2f}", ours.seconds)));
}

std::string section(const studies::CaseResult& result) {
    std::string html = fmt::format("<h2>{}. {}</h2>\n<p>{} <code>hard/{}</code></p>\n", result.study.number,
                                   escaped(result.name), escaped(result.title), escaped(result.name));
    html +=
        "<table>\n<tr><th>changes</th><th>observable</th><th>paper's stepper</th><th>ours</th><th>limit</th>"
        "<th>particles</th><th>steps</th><th>rejected</th><th>seconds</th></tr>\n";
    for (const studies::VariantResult& variant : result.variants) html += variantRow(variant);
    return html + "</table>\n";
}

std::string glossary() {
    std::string html = "<h2>The observables</h2>\n<dl>\n";
    for (const scenes::ObservableInfo& info : scenes::observables())
        html += fmt::format("<dt><code>{}</code></dt><dd>{}</dd>\n", escaped(std::string(info.name)),
                            escaped(std::string(info.help)));
    return html + "</dl>\n";
}

}  // namespace

std::string stabilityPage(const std::vector<studies::CaseResult>& results, const std::string& command) {
    std::string html = kHead;
    html += fmt::format(
        "<p>Made by <code>{}</code>. Each row shows the worst variant of a case: the paper's stepper (symplectic Euler "
        "at its published step, with its clamp of the distance) and ours, with the stepper that the scene names. "
        "Seconds "
        "and steps are ours.</p>\n",
        escaped(command));
    html += summaryTable(results);
    for (const studies::CaseResult& result : results) html += section(result);
    return html + glossary() + "</body></html>\n";
}

}  // namespace tools
