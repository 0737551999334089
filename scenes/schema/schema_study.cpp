// Rows of the schema: [study], the table of the hard cases.
#include "scenes/schema/schema_rows.h"
#include "scenes/schema/study.h"

namespace scenes {
namespace {

std::vector<std::string_view> observableNames() {
    std::vector<std::string_view> names;
    for (const ObservableInfo& info : observables()) names.push_back(info.name);
    return names;
}

std::vector<Key> measureRows() {
    return {
        {.path = "study.number",
         .type = Type::integer,
         .required = true,
         .range = {.low = 1.0, .high = 1e3},
         .help = "place in the table of the study"},
        {.path = "study.observable",
         .type = Type::choice,
         .required = true,
         .choices = observableNames(),
         .help = "what is measured; globular study stability --help explains each"},
        {.path = "study.limit", .required = true, .range = kNotNegative, .help = "the observable passes up to this"},
        {.path = "study.at_least",
         .derived = "no lower limit",
         .range = kNotNegative,
         .help = "the observable passes from this on"},
    };
}

std::vector<Key> runRows() {
    return {
        {.path = "study.paper_must_fail",
         .type = Type::boolean,
         .fallback = "false",
         .help = "the paper's stepper has to fail"},
        {.path = "study.paper_step",
         .unit = "s",
         .fallback = "0.01",
         .range = kPositive,
         .help = "of the paper's stepper"},
        {.path = "study.reference_step",
         .unit = "s",
         .derived = "no reference",
         .range = kPositive,
         .help = "of the run that errors are taken against"},
        {.path = "study.reference_stepper",
         .type = Type::choice,
         .fallback = "\"velocity-verlet\"",
         .choices = {"symplectic-euler", "velocity-verlet", "leapfrog", "implicit-damping", "linearly-implicit"},
         .help = "of the run that errors are taken against"},
        {.path = "study.vary",
         .type = Type::textList,
         .fallback = "[]",
         .help = "variants of the scene, each as KEY=VALUE; KEY=VALUE like --set; none: the scene as it is"},
        {.path = "study.quick",
         .type = Type::textList,
         .derived = "those of vary",
         .help = "variants that a quick run takes"},
    };
}

}  // namespace

std::vector<Key> studyRows() {
    std::vector<Key> rows = measureRows();
    for (Key& row : runRows()) rows.push_back(std::move(row));
    return rows;
}

}  // namespace scenes
