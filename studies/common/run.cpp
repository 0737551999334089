// The loop over frames.
#include "studies/common/run.h"

#include <fmt/format.h>

#include <chrono>

#include "scenes/view/frame_steps.h"

namespace studies {

namespace {

/// Nobody leaves; a run that loses some is broken, and what is measured of the rest means nothing.
void requireAll(const Run& run) {
    if (!run.frames.empty() && run.end.particles.count() < run.frames.back().count())
        throw engine::InstabilityError(fmt::format("the run lost particles: {} of {} are left at {} s",
                                                   run.end.particles.count(), run.frames.back().count(), run.end.time));
}

void keepFrame(Run& run) {
    requireAll(run);
    run.frames.push_back(run.end.particles);
    run.stepsUntil.push_back(run.end.steps.count);
}

}  // namespace

Run runScene(const scenes::Scene& scene) {
    Run run;
    const auto begin = std::chrono::steady_clock::now();
    engine::Setup setup = scene.setup;
    setup.world.reset();  // observables follow every particle
    run.end = engine::start(setup);
    try {
        keepFrame(run);
        // frameCount() is the number of pictures; the last moment of the scene is one interval after the last of them.
        for (int frame = 1; frame <= scenes::frameCount(scene); ++frame) {
            scenes::advanceToFrame(scene, run.end, frame);
            keepFrame(run);
        }
    } catch (const engine::InstabilityError& error) {
        run.failure = Failure{run.end.time, error.what()};
    }
    run.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    return run;
}

}  // namespace studies
