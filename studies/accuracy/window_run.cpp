// Runs a window of a scene with another stepper, frame by frame against the clock. See window_run.h.
#include "studies/accuracy/window_run.h"

#include <chrono>

#include "engine/error_control/auto_stepper.h"
#include "engine/error_control/step_cost.h"
#include "engine/stepping/take_step.h"
#include "scenes/view/frame_view.h"

namespace studies {
namespace {

/// A new simulation in the state at the start of the window, without what the scene's own stepper has cached.
engine::Simulation begin(const Window& window, const Variant& variant) {
    engine::Setup setup = window.start.setup;
    setup.initial = {};
    setup.world.reset();  // without bounds no particle is removed, so that all can be compared at the end
    setup.stepper = variant.stepper;
    setup.precision = variant.precision;
    if (variant.stepper == engine::StepperKind::automatic)
        setup.error = variant.asked;
    else
        setup.step = variant.asked;
    if (variant.solverTolerance) setup.solverTolerance = *variant.solverTolerance;
    engine::Simulation simulation = engine::start(setup);
    simulation.particles = window.start.particles;
    simulation.emitters = window.start.emitters;
    simulation.time = window.start.time;
    return simulation;
}

/// Puts the automatic stepper into the middle of a run: it has chosen a stepper and a step for this state, and its next
/// error estimate is half of the longest pause away. The cost of the choice is not counted.
void chooseStepper(const Window& window, engine::Simulation& simulation) {
    engine::Simulation scout = simulation;
    scenes::advanceToFrame(window.scene, scout, window.firstFrame + 1);
    if (scout.particles.count() == 0) return;  // there was nothing to choose
    simulation.automatic = scout.automatic;
    simulation.automatic.twin = {};
    simulation.automatic.nextTwin = simulation.automatic.intervalCount + engine::kLongestPause / 2;
    simulation.automatic.estimateCost = 0.0;
    simulation.stepper = scout.stepper;
}

}  // namespace

double Window::seconds() const {
    return scenes::frameTime(scene, lastFrame) - scenes::frameTime(scene, firstFrame);
}

std::string nameOf(const Variant& variant) {
    const std::string stepper(engine::nameOf(variant.stepper));
    return variant.precision == engine::Precision::singles ? stepper + " in float" : stepper;
}

bool isOf(const Variant& variant, engine::StepperKind stepper, engine::Precision precision) {
    return variant.stepper == stepper && variant.precision == precision;
}

std::string_view nameOf(Ending ending) {
    return ending == Ending::finished ? "finished" : ending == Ending::unstable ? "unstable" : "too slow";
}

Window openWindow(const scenes::Scene& scene, int firstFrame, int frameCount) {
    Window window{scene, engine::start(scene.setup), firstFrame, firstFrame + frameCount};
    scenes::advanceToFrame(scene, window.start, firstFrame);
    return window;
}

WindowRun runWindow(const Window& window, const Variant& variant, double secondsLimit) {
    using Clock = std::chrono::steady_clock;
    engine::Simulation simulation = begin(window, variant);
    WindowRun run;
    run.variant = variant;
    Clock::time_point start = Clock::now();
    const auto elapsed = [&] { return std::chrono::duration<double>(Clock::now() - start).count(); };
    try {
        if (variant.stepper == engine::StepperKind::automatic) chooseStepper(window, simulation);
        start = Clock::now();
        for (int frame = window.firstFrame + 1; frame <= window.lastFrame; ++frame) {
            scenes::advanceToFrame(window.scene, simulation, frame);
            if (frame == window.lastFrame || elapsed() <= secondsLimit) continue;
            run.ending = Ending::tooSlow;
            break;
        }
    } catch (const engine::InstabilityError& error) {
        run.ending = Ending::unstable;
        run.failureMessage = error.what();
    }
    run.seconds = elapsed();
    run.steps = simulation.steps;
    run.errorEstimateCost = simulation.automatic.estimateCost;
    run.evaluationCost = engine::forceEvaluationsOf(simulation) + run.errorEstimateCost;
    if (run.ending == Ending::finished) run.energy = engine::energy(simulation);
    run.particles = std::move(simulation.particles);
    return run;
}

}  // namespace studies
