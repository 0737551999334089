// The study of stability runs hard cases: scenes with an observable and a limit. Each variant of a case is run with the
// paper's stepper and with the scene's own, and the observable is compared with the limit. Called by
// `globular study stability`.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/run/advance.h"
#include "scenes/model/scene.h"

namespace studies {

/// Why a run ended before the scene did.
struct Failure {
    double time = 0.0;  ///< scene time of the failure, s
    std::string message;
};

/// A run of a scene, with all of its frames.
struct Run {
    std::vector<engine::Particles> frames;  ///< particles at every frame, from frame 0 to the end or to a failure
    std::vector<std::uint64_t> stepsUntil;  ///< number of steps taken until each frame
    engine::Simulation end;                 ///< the simulation at the end of the run
    double seconds = 0.0;                   ///< wall-clock time of the run
    std::optional<Failure> failure;
};

/// Runs a scene with its own stepper from frame 0 to the frame at its duration, that frame included. World bounds are
/// ignored, because observables follow every particle. A run that becomes unstable is returned with its failure.
Run runScene(const scenes::Scene& scene);

/// What came out of the run of one variant with one stepper.
struct Outcome {
    std::string stepper;
    std::optional<Failure> failure;  ///< failure of the run, or of a run that the observable needs
    double value = 0.0;              ///< value of the observable; infinite after a failure
    bool passes = false;             ///< whether the observable is within the limit
    engine::StepStatistics steps;
    std::size_t particles = 0;  ///< number of particles at the end of the run
    double seconds = 0.0;       ///< wall-clock time of the run
};

/// A variant of a hard case, which changes some keys of the scene, and its outcomes.
struct VariantResult {
    std::string changes;            ///< changed keys as in the scene file; empty: none
    scenes::Study study;            ///< observable and limit, with the changes applied
    Outcome paper;                  ///< outcome of the paper's stepper at the paper's step
    Outcome ours;                   ///< outcome of the scene's own stepper and step
    double referenceSeconds = 0.0;  ///< wall-clock time of the reference run; 0 without one
};

/// The results of all variants of a hard case.
struct CaseResult {
    std::string name;
    std::string title;
    scenes::Study study;
    std::vector<VariantResult> variants;
    double seconds = 0.0;  ///< wall-clock time of the whole case
};

/// How far a value is from its limits: the value over the limit of the study, or the lower limit over the value,
/// whichever is larger. At most 1 if the value passes; infinite for NaN.
double limitRatio(const scenes::Study& study, double value);

/// The variant with the largest limit ratio for one of the steppers, &VariantResult::ours or &VariantResult::paper.
const VariantResult& worstVariant(const CaseResult& result, const Outcome VariantResult::*stepper);

/// Whether the scene's own stepper passes in every variant of a case.
bool oursPasses(const CaseResult& result);

/// Whether the paper's stepper fails in every variant of a case in which the scene file says that it must.
bool paperIsAsExpected(const CaseResult& result);

/// Which hard case is run: a scene that strains the stability of the stepper.
struct CaseOptions {
    std::string name;
    std::string path;    ///< path of the scene file
    bool quick = false;  ///< whether only the quick variants are run
};

/// Runs all variants of a hard case.
/// @throws scenes::InputError for a faulty scene, and for one without [study]
CaseResult runCase(const CaseOptions& options);

// The results as text: the rows of the table on the terminal and the page, and CSV.

inline const std::vector<std::string> kStabilityColumns = {"#",     "case",  "paper's stepper", "ours",  "observable",
                                                           "value", "limit", "result",          "steps", "seconds"};

/// The row of a hard case in the table: the results of its worst variant for each of the two steppers.
std::vector<std::string> rowOf(const CaseResult& result);

/// The outcome of a run in words, for example "exploded at 0.12 s", "3.1: fails" or "0.002: passes".
std::string outcomeText(const Outcome& outcome);

/// A text with a line for each variant of the cases that did not come out as it must; empty if all did.
std::string stabilityProblems(const std::vector<CaseResult>& results);

/// CSV with a header line and a line for each variant of each case.
std::string stabilityCsv(const std::vector<CaseResult>& results);

}  // namespace studies
