// A variant is a scene of its own; everything else is a loop over them.
#include "studies/stability/stability.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "engine/stepping/steppers.h"
#include "scenes/text/input_error.h"
#include "studies/common/infinity.h"
#include "studies/stability/observables.h"

namespace studies {
namespace {

/// The clamp that the published program puts on D: the radius of equal particles.
constexpr double kPaperCore = 0.5;

scenes::Scene withPaperStepper(scenes::Scene scene) {
    scene.setup.stepper = engine::StepperKind::symplecticEuler;
    scene.setup.step = scene.study->paperStep;
    for (engine::Material& material : scene.setup.materials) material.coreFraction = kPaperCore;
    return scene;
}

scenes::Scene atReferenceStep(scenes::Scene scene) {
    scene.setup.stepper = scene.study->referenceStepper;
    scene.setup.step = *scene.study->referenceStep;
    return scene;
}

/// The value, or the failure of a measurement that takes runs of its own.
void measureInto(Outcome& outcome, const ObservableInput& trial) {
    try {
        outcome.value = measure(trial.scene.study->observable, trial);
    } catch (const engine::InstabilityError& error) {
        outcome.failure = Failure{trial.run.end.time, error.what()};
    }
}

Outcome outcomeOf(const scenes::Scene& scene, const Run* reference) {
    const Run run = runScene(scene);
    Outcome outcome;
    outcome.stepper = engine::nameOf(scene.setup.stepper);
    outcome.failure = run.failure;
    outcome.value = kInfinity;
    outcome.steps = run.end.steps;
    outcome.particles = run.end.particles.count();
    outcome.seconds = run.seconds;
    if (!run.failure) measureInto(outcome, {scene, run, reference});
    outcome.passes = limitRatio(*scene.study, outcome.value) <= 1.0;
    return outcome;
}

/// The reference has to stand; a case whose reference does not is wrong.
Run referenceRun(const scenes::Scene& scene) {
    Run run = runScene(atReferenceStep(scene));
    if (run.failure)
        throw scenes::InputError(
            {{scene.sourceName, 0, 0, fmt::format("the reference became unstable: {}", run.failure->message)}});
    return run;
}

VariantResult runVariant(const std::string& path, const std::string& changes) {
    const scenes::Scene scene = scenes::loadScene(path, scenes::overridesOf(changes));
    VariantResult result;
    result.changes = changes;
    result.study = *scene.study;
    std::optional<Run> reference;
    if (scenes::infoOf(scene.study->observable).needsReference) {
        reference = referenceRun(scene);
        result.referenceSeconds = reference->seconds;
    }
    const Run* against = reference ? &*reference : nullptr;
    result.paper = outcomeOf(withPaperStepper(scene), against);
    result.ours = outcomeOf(scene, against);
    return result;
}

const VariantResult& worst(const CaseResult& result, const Outcome VariantResult::*stepper) {
    return *std::max_element(result.variants.begin(), result.variants.end(), [&](const auto& a, const auto& b) {
        return limitRatio(a.study, (a.*stepper).value) < limitRatio(b.study, (b.*stepper).value);
    });
}

}  // namespace

double limitRatio(const scenes::Study& study, double value) {
    if (!std::isfinite(value)) return kInfinity;
    // A limit of nothing is passed by nothing only.
    const double above = study.limit > 0.0 ? value / study.limit : value <= 0.0 ? 0.0 : 1.0 + value;
    const double below = !study.atLeast ? 0.0 : value > 0.0 ? *study.atLeast / value : kInfinity;
    return std::max(above, below);
}

const VariantResult& worstOfOurs(const CaseResult& result) {
    return worst(result, &VariantResult::ours);
}

const VariantResult& worstOfPaper(const CaseResult& result) {
    return worst(result, &VariantResult::paper);
}

bool oursPasses(const CaseResult& result) {
    return worstOfOurs(result).ours.passes;
}

bool paperIsAsExpected(const CaseResult& result) {
    return std::none_of(result.variants.begin(), result.variants.end(), [](const VariantResult& variant) {
        return variant.study.paperMustFail && variant.paper.passes;
    });
}

CaseResult runCase(const CaseOptions& options) {
    const auto begin = std::chrono::steady_clock::now();
    const scenes::Scene scene = scenes::loadScene(options.path, {});
    if (!scene.study)
        throw scenes::InputError({{options.path, 0, 0, "the scene has no [study], so it is no hard case"}});
    CaseResult result;
    result.name = options.name;
    result.title = scene.title;
    result.study = *scene.study;
    for (const std::string& variant : scenes::variantsOf(*scene.study, options.quick))
        result.variants.push_back(runVariant(options.path, variant));
    result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    return result;
}

}  // namespace studies
