// The hard cases: scenes with an observable and a limit. Each variant of a case is run with the paper's stepper and
// with the scene's own, and the observable is compared with the limit. Called by `globular study stability`.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scenes/model/scene.h"
#include "studies/stability/recorded_run.h"

namespace studies {

/// The run of one variant with one stepper.
struct Outcome {
    std::string stepper;
    std::optional<Failure> failure;  ///< if the run, or a run that the observable needs, became unstable
    double value = 0.0;              ///< of the observable; infinite after a failure
    bool passes = false;             ///< whether the value is within the limit
    engine::StepStatistics steps;
    std::size_t particles = 0;  ///< number of particles at the end
    double seconds = 0.0;       ///< wall clock of the simulation
};

/// A variant of a case.
struct VariantResult {
    std::string changes;            ///< the changed keys, as in the scene file; empty if there are none
    scenes::Study study;            ///< with the changes applied
    Outcome paper;                  ///< the paper's stepper at the paper's step
    Outcome ours;                   ///< the stepper and step of the scene
    double referenceSeconds = 0.0;  ///< wall clock of the reference run; 0 if there is none
};

/// A case with all of its variants.
struct CaseResult {
    std::string name;
    std::string title;
    scenes::Study study;
    std::vector<VariantResult> variants;
    double seconds = 0.0;  ///< wall clock of the whole case
};

/// The value over the limit of the study, or the lower limit over the value, whichever is larger: at most 1 if the
/// value passes, infinite for NaN.
double limitRatio(const scenes::Study& study, double value);

/// The variant with the largest limit ratio for one of the steppers, &VariantResult::ours or &VariantResult::paper.
const VariantResult& worstVariant(const CaseResult& result, const Outcome VariantResult::*stepper);

/// Whether the scene's own stepper passes in every variant.
bool oursPasses(const CaseResult& result);

/// Whether the paper's stepper fails in every variant where the study says that it must.
bool paperIsAsExpected(const CaseResult& result);

struct CaseOptions {
    std::string name;
    std::string path;    ///< of the scene file
    bool quick = false;  ///< run the quick variants only
};

/// Runs a case.
/// @throws scenes::InputError for a faulty scene, and for one without [study]
CaseResult runCase(const CaseOptions& options);

// The results as text: the rows of the table on the terminal and the page, and CSV.

inline const std::vector<std::string> kStabilityColumns = {"#",     "case",  "paper's stepper", "ours",  "observable",
                                                           "value", "limit", "result",          "steps", "seconds"};

/// A case as a row of the table, by its worst variant for each of the two steppers.
std::vector<std::string> rowOf(const CaseResult& result);

/// For example "exploded at 0.12 s", "3.1: fails" or "0.002: passes".
std::string outcomeText(const Outcome& outcome);

/// A line for each variant that did not come out as it must; empty if all did.
std::string stabilityProblems(const std::vector<CaseResult>& results);

/// Every variant of every case, with a header line.
std::string stabilityCsv(const std::vector<CaseResult>& results);

}  // namespace studies
