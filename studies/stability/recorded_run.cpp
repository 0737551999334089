// Runs a scene and keeps the particles at every frame. See recorded_run.h.
#include "studies/stability/recorded_run.h"

#include <fmt/format.h>

#include "scenes/view/frame_view.h"
#include "studies/common/timing.h"

namespace studies {

namespace {

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

}  // namespace studies
