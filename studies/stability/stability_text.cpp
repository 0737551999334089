// The results of the study of stability as text: a table, the problems in words, and CSV. See stability.h.
#include "studies/stability/stability.h"

#include <fmt/format.h>

#include "studies/common/report.h"

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

/// The limits of an observable in words, for example "0.03" or "1.9 to 2.1".
std::string limitText(const scenes::Study& study) {
    return study.atLeast ? fmt::format("{:g} to {:g}", *study.atLeast, study.limit) : fmt::format("{:g}", study.limit);
}

/// An outcome as the fields of a CSV line.
std::string csvOutcome(const Outcome& outcome) {
    const engine::StepStatistics& steps = outcome.steps;
    return csvFields(outcome.stepper,
                     outcome.failure  ? "exploded"
                     : outcome.passes ? "passes"
                                      : "fails",
                     outcome.value, outcome.particles, steps.count, steps.shortest, steps.longest,
                     steps.forceEvaluations, steps.products, steps.rejected, outcome.seconds);
}

constexpr const char* kCsvHeader =
    "number,case,changes,observable,unit,limit,at_least,paper_stepper,paper_outcome,paper_value,paper_particles,"
    "paper_steps,paper_shortest_s,paper_longest_s,paper_force_evaluations,paper_products,paper_rejected,paper_seconds,"
    "stepper,outcome,value,particles,steps,shortest_s,longest_s,force_evaluations,products,rejected,seconds,"
    "reference_seconds\n";

/// The outcome of the paper's stepper in its worst variant, in words. The row of the table may show another variant; if
/// that has another observable, the observable is named.
std::string paperText(const VariantResult& worst, scenes::Observable rowObservable) {
    const bool isNamed = !worst.paper.failure && worst.study.observable != rowObservable;
    return (isNamed ? std::string(scenes::infoOf(worst.study.observable).name) + " " : "") + outcomeText(worst.paper);
}

}  // namespace

std::string outcomeText(const Outcome& outcome) {
    if (outcome.failure) return valueText(outcome);
    return fmt::format("{}: {}", valueText(outcome), outcome.passes ? "passes" : "fails");
}

std::vector<std::string> rowOf(const CaseResult& result) {
    const VariantResult& ours = worstVariant(result, &VariantResult::ours);
    const char* verdict = !oursPasses(result) ? "FAIL" : !paperIsAsExpected(result) ? "paper passes" : "pass";
    return {fmt::format("{}", result.study.number),
            result.name,
            paperText(worstVariant(result, &VariantResult::paper), ours.study.observable),
            ours.ours.stepper,
            observableText(ours.study),
            valueText(ours.ours),
            limitText(ours.study),
            verdict,
            fmt::format("{}", ours.ours.steps.count),
            fmt::format("{:.2f}", ours.ours.seconds)};
}

std::string stabilityProblems(const std::vector<CaseResult>& results) {
    std::string text;
    for (const CaseResult& result : results)
        for (const VariantResult& variant : result.variants) {
            const std::string variantName = fmt::format("{} [{}]", result.name, variant.changes);
            if (variant.study.paperMustFail && variant.paper.passes)
                text += fmt::format("{}: the paper's stepper passes, must fail\n", variantName);
            if (!variant.ours.passes)
                text += fmt::format("{}: {} is {}, must be {}{}\n", variantName, observableText(variant.study),
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
            text += fmt::format("{},{},{},{:.6g}\n",
                                csvFields(result.study.number, result.name, variant.changes, info.name, info.unit,
                                          variant.study.limit, variant.study.atLeast),
                                csvOutcome(variant.paper), csvOutcome(variant.ours), variant.referenceSeconds);
        }
    return text;
}

}  // namespace studies
