// Numbers to text. Nothing is computed here.
#include "studies/stability/stability_text.h"

#include <fmt/format.h>

#include <algorithm>

#include "studies/common/csv.h"

namespace studies {
namespace {

std::string observableText(const scenes::Study& study) {
    const scenes::ObservableInfo& info = scenes::infoOf(study.observable);
    return info.unit.empty() ? std::string(info.name) : fmt::format("{}, {}", info.name, info.unit);
}

std::string valueText(const Outcome& outcome) {
    return outcome.failure ? fmt::format("exploded at {:.3g} s", outcome.failure->time)
                           : fmt::format("{:.3g}", outcome.value);
}

std::string csvOutcome(const Outcome& outcome) {
    return fmt::format("{},{},{},{},{},{},{},{},{},{},{:.4g}", outcome.stepper,
                       outcome.failure  ? "exploded"
                       : outcome.passes ? "passes"
                                        : "fails",
                       outcome.value, outcome.particles, outcome.steps.count, outcome.steps.shortest,
                       outcome.steps.longest, outcome.steps.forceEvaluations, outcome.steps.products,
                       outcome.steps.rejected, outcome.seconds);
}

constexpr const char* kCsvHeader =
    "number,case,changes,observable,unit,limit,at_least,paper_stepper,paper_outcome,paper_value,paper_particles,"
    "paper_steps,paper_shortest_s,paper_longest_s,paper_force_evaluations,paper_products,paper_rejected,paper_seconds,"
    "stepper,outcome,value,particles,steps,shortest_s,longest_s,force_evaluations,products,rejected,seconds,"
    "reference_seconds\n";

}  // namespace

std::string limitText(const scenes::Study& study) {
    return study.atLeast ? fmt::format("{:g} to {:g}", *study.atLeast, study.limit) : fmt::format("{:g}", study.limit);
}

std::string outcomeText(const Outcome& outcome) {
    if (outcome.failure) return valueText(outcome);
    return fmt::format("{}: {}", valueText(outcome), outcome.passes ? "passes" : "fails");
}

namespace {

/// Of the paper's stepper at its worst; what was observed is said where it is not what the row is about.
std::string paperText(const VariantResult& paper, scenes::Observable ofRow) {
    const bool isNamed = !paper.paper.failure && paper.study.observable != ofRow;
    return (isNamed ? std::string(scenes::infoOf(paper.study.observable).name) + " " : "") + outcomeText(paper.paper);
}

}  // namespace

StabilityRow rowOf(const CaseResult& result) {
    const VariantResult& ours = worstOfOurs(result);
    const char* judged = !oursPasses(result) ? "FAIL" : !paperIsAsExpected(result) ? "paper passes" : "pass";
    return {fmt::format("{}", result.study.number),
            result.name,
            paperText(worstOfPaper(result), ours.study.observable),
            ours.ours.stepper,
            observableText(ours.study),
            valueText(ours.ours),
            limitText(ours.study),
            judged,
            fmt::format("{}", ours.ours.steps.count),
            fmt::format("{:.2f}", ours.ours.seconds)};
}

std::string stabilityTable(const std::vector<CaseResult>& results) {
    std::vector<StabilityRow> rows(1);
    std::copy(kStabilityColumns.begin(), kStabilityColumns.end(), rows[0].begin());
    for (const CaseResult& result : results) rows.push_back(rowOf(result));
    std::array<std::size_t, kStabilityColumns.size()> widths{};
    for (const StabilityRow& row : rows)
        for (std::size_t column = 0; column < row.size(); ++column)
            widths[column] = std::max(widths[column], row[column].size());
    std::string text;
    for (const StabilityRow& row : rows) {
        std::string line;
        for (std::size_t column = 0; column < row.size(); ++column)
            line += fmt::format("{:<{}}  ", row[column], widths[column]);
        text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
    }
    return text;
}

std::string stabilityProblems(const std::vector<CaseResult>& results) {
    std::string text;
    for (const CaseResult& result : results)
        for (const VariantResult& variant : result.variants) {
            const std::string who = fmt::format("{} [{}]", result.name, variant.changes);
            if (variant.study.paperMustFail && variant.paper.passes)
                text += fmt::format("{}: the paper's stepper passes, must fail\n", who);
            if (!variant.ours.passes)
                text += fmt::format("{}: {} is {}, must be {}{}\n", who, observableText(variant.study),
                                    valueText(variant.ours), limitText(variant.study),
                                    variant.ours.failure ? ": " + variant.ours.failure->message : "");
        }
    return text;
}

std::string stabilityCsv(const std::vector<CaseResult>& results) {
    std::string text = kCsvHeader;
    for (const CaseResult& result : results)
        for (const VariantResult& variant : result.variants) {
            const scenes::ObservableInfo& info = scenes::infoOf(variant.study.observable);
            text += fmt::format("{},{},{},{},{},{},{},{},{},{:.4g}\n", result.study.number, csvField(result.name),
                                csvField(variant.changes), info.name, info.unit, variant.study.limit,
                                variant.study.atLeast ? fmt::format("{}", *variant.study.atLeast) : "",
                                csvOutcome(variant.paper), csvOutcome(variant.ours), variant.referenceSeconds);
        }
    return text;
}

}  // namespace studies
