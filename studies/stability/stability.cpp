// Runs the hard cases: each variant is loaded as a scene of its own and run with both steppers. See stability.h.
#include "studies/stability/stability.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/stepping/take_step.h"
#include "scenes/build/read_scene.h"
#include "scenes/text/input_error.h"
#include "scenes/view/frame_view.h"
#include "studies/common/state_difference.h"
#include "studies/common/timing.h"
#include "studies/stability/observables.h"

namespace studies {
namespace {

/// The core distance of the paper's program, which clamps the distance of two particles at one radius, in rest lengths.
constexpr double kPaperCore = 0.5;

/// A scene with the paper's stepper, step, core distance and walls.
scenes::Scene withPaperStepper(scenes::Scene scene) {
    scene.setup.stepper = engine::StepperKind::symplecticEuler;
    scene.setup.step = scene.study->paperStep;
    scene.setup.obstacles.wall = engine::WallLaw::paper;
    for (engine::Material& material : scene.setup.materials) material.coreFraction = kPaperCore;
    return scene;
}

/// Appends the present state of the simulation to the recorded frames. Without world bounds no particle is removed, so
/// a run with fewer particles than before is broken, and observables of the rest would mean nothing.
/// @throws engine::InstabilityError if particles are missing
void recordFrame(Run& run) {
    if (!run.frames.empty() && run.end.particles.count() < run.frames.back().count())
        throw engine::InstabilityError(fmt::format("the run lost particles: {} of {} are left at {} s",
                                                   run.end.particles.count(), run.frames.back().count(), run.end.time));
    run.frames.push_back(run.end.particles);
    run.stepsUntil.push_back(run.end.steps.count);
}

/// Runs a scene with its stepper and compares the observable with the limit.
Outcome outcomeOf(const scenes::Scene& scene, const Run* reference) {
    const Run run = runScene(scene);
    Outcome outcome;
    outcome.stepper = engine::nameOf(scene.setup.stepper);
    outcome.failure = run.failure;
    outcome.value = kInfinity;
    outcome.steps = run.end.steps;
    outcome.particles = run.end.particles.count();
    outcome.seconds = run.seconds;
    try {
        if (!run.failure) outcome.value = measure(scene.study->observable, {scene, run, reference});
    } catch (const engine::InstabilityError& error) {
        // A run that the observable makes itself has become unstable.
        outcome.failure = Failure{run.end.time, error.what()};
    }
    outcome.passes = limitRatio(*scene.study, outcome.value) <= 1.0;
    return outcome;
}

/// Runs the scene at its reference step. A reference that becomes unstable is a fault of the scene file.
Run referenceRun(scenes::Scene scene) {
    scene.setup.stepper = scene.study->referenceStepper;
    scene.setup.step = *scene.study->referenceStep;
    Run run = runScene(scene);
    if (run.failure)
        throw scenes::InputError(scene.sourceName,
                                 fmt::format("the reference became unstable: {}", run.failure->message));
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

}  // namespace

Run runScene(const scenes::Scene& scene) {
    Run run;
    run.seconds = secondsOf([&] {
        engine::Setup setup = scene.setup;
        setup.world.reset();
        run.end = engine::start(setup);
        try {
            recordFrame(run);
            // The scene ends one frame interval after the last of the frameCount() frames that are drawn.
            for (int frame = 1; frame <= scenes::frameCount(scene); ++frame) {
                scenes::advanceToFrame(scene, run.end, frame);
                recordFrame(run);
            }
        } catch (const engine::InstabilityError& error) {
            run.failure = Failure{run.end.time, error.what()};
        }
    });
    return run;
}

double limitRatio(const scenes::Study& study, double value) {
    if (!std::isfinite(value)) return kInfinity;
    // If the limit is 0, values of at most 0 pass.
    const double above = study.limit > 0.0 ? value / study.limit : value <= 0.0 ? 0.0 : 1.0 + value;
    const double below = !study.atLeast ? 0.0 : value > 0.0 ? *study.atLeast / value : kInfinity;
    return std::max(above, below);
}

const VariantResult& worstVariant(const CaseResult& result, const Outcome VariantResult::*stepper) {
    return *std::max_element(result.variants.begin(), result.variants.end(), [&](const auto& a, const auto& b) {
        return limitRatio(a.study, (a.*stepper).value) < limitRatio(b.study, (b.*stepper).value);
    });
}

bool oursPasses(const CaseResult& result) {
    return worstVariant(result, &VariantResult::ours).ours.passes;
}

bool paperIsAsExpected(const CaseResult& result) {
    return std::none_of(result.variants.begin(), result.variants.end(), [](const VariantResult& variant) {
        return variant.study.paperMustFail && variant.paper.passes;
    });
}

CaseResult runCase(const CaseOptions& options) {
    const scenes::Scene scene = scenes::loadScene(options.path, {});
    if (!scene.study) throw scenes::InputError(options.path, "the scene has no [study], so it is no hard case");
    CaseResult result;
    result.name = options.name;
    result.title = scene.title;
    result.study = *scene.study;
    result.seconds = secondsOf([&] {
        for (const std::string& variant : scenes::variantsOf(*scene.study, options.quick))
            result.variants.push_back(runVariant(options.path, variant));
    });
    return result;
}

}  // namespace studies
