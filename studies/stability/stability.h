// The hard cases judged: each variant of a case run with the paper's stepper and with ours, the observable measured,
// the limit held against it.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "engine/run/advance.h"
#include "scenes/model/scene.h"
#include "studies/common/run.h"

namespace studies {

/// One stepper on one variant.
struct Outcome {
    std::string stepper;
    std::optional<Failure> failure;  ///< the run, or the measuring, became unstable
    double value = 0.0;              ///< of the observable; infinite after a failure
    bool passes = false;
    engine::StepStatistics steps;
    std::size_t particles = 0;  ///< at the end
    double seconds = 0.0;       ///< of simulating
};

/// A variant of a case.
struct VariantResult {
    std::string changes;  ///< as in the scene file; empty: none
    scenes::Study study;  ///< with the changes
    Outcome paper;
    Outcome ours;
    double referenceSeconds = 0.0;  ///< 0 without a reference
};

/// A case with all its variants.
struct CaseResult {
    std::string name;
    std::string title;
    scenes::Study study;
    std::vector<VariantResult> variants;
    double seconds = 0.0;  ///< of everything
};

/// How far a value is from passing: at most 1 where it passes, infinite where it is not a number.
double limitRatio(const scenes::Study& study, double value);

/// The variant in which ours, or the paper's stepper, comes off worst.
const VariantResult& worstOfOurs(const CaseResult& result);
const VariantResult& worstOfPaper(const CaseResult& result);

/// Ours passes in every variant.
bool oursPasses(const CaseResult& result);

/// The paper's stepper fails in every variant where it has to.
bool paperIsAsExpected(const CaseResult& result);

/// Which case, and how.
struct CaseOptions {
    std::string name;
    std::string path;
    bool quick = false;
};

/// Runs a case. Throws: scenes::InputError, also for a scene without [study].
CaseResult runCase(const CaseOptions& options);

}  // namespace studies
