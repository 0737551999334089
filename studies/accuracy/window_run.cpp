// Runs a window of a scene with another stepper, frame by frame against the clock. See window_run.h.
#include "studies/accuracy/window_run.h"

#include <cstdint>
#include <limits>
#include <utility>

#include "engine/error_control/step_cost.h"
#include "engine/stepping/take_step.h"
#include "scenes/view/frame_view.h"
#include "studies/common/timing.h"

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

/// Runs the scene with the automatic stepper at a wanted error (radii per second) from its start to the end of a
/// window.
/// @throws engine::InstabilityError
LeadIn leadInTo(const Window& window, double error) {
    engine::Setup setup = window.scene.setup;
    setup.stepper = engine::StepperKind::automatic;
    setup.error = error;
    engine::Simulation simulation = engine::start(setup);
    scenes::advanceToFrame(window.scene, simulation, window.firstFrame);
    LeadIn leadIn{simulation.automatic, simulation.stepper};
    scenes::advanceToFrame(window.scene, simulation, window.lastFrame);
    const double cost = engine::forceEvaluationsOf(simulation);
    leadIn.trialShare = cost > 0.0 ? simulation.automatic.estimateCost / cost : 0.0;
    leadIn.state.twin = {};
    return leadIn;
}

/// Puts the automatic stepper into the state at the end of the lead-in, with no trial run due within the window.
void follow(const LeadIn& leadIn, engine::Simulation& simulation) {
    simulation.automatic = leadIn.state;
    simulation.automatic.nextTwin = std::numeric_limits<std::uint64_t>::max();
    simulation.automatic.estimateCost = 0.0;
    simulation.stepper = leadIn.stepper;
}

/// Charges a run with the trial runs that it has not made, at their share of its own cost.
void charge(WindowRun& run, double trialShare) {
    const double due = trialShare * (run.evaluationCost - run.errorEstimateCost);
    if (run.evaluationCost > 0.0) run.seconds *= 1.0 + due / run.evaluationCost;
    run.errorEstimateCost += due;
    run.evaluationCost += due;
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

WindowRun timeFrames(const scenes::Scene& scene, engine::Simulation& simulation, int firstFrame, int lastFrame,
                     double secondsLimit, const std::function<void(int)>& afterFrame) {
    WindowRun run;
    try {
        for (int frame = firstFrame + 1; frame <= lastFrame; ++frame) {
            run.seconds += secondsOf([&] { scenes::advanceToFrame(scene, simulation, frame); });
            if (afterFrame) afterFrame(frame);
            if (frame == lastFrame || run.seconds <= secondsLimit) continue;
            run.ending = Ending::tooSlow;
            break;
        }
    } catch (const engine::InstabilityError& error) {
        run.ending = Ending::unstable;
        run.failureMessage = error.what();
    }
    run.steps = simulation.steps;
    run.errorEstimateCost = simulation.automatic.estimateCost;
    run.evaluationCost = engine::forceEvaluationsOf(simulation) + run.errorEstimateCost;
    if (run.ending == Ending::finished) run.energy = engine::energy(simulation);
    return run;
}

WindowRun runWindow(const Window& window, const Variant& variant, double secondsLimit, std::optional<LeadIn> leadIn) {
    const bool isLed = variant.stepper == engine::StepperKind::automatic && window.firstFrame > 0;
    WindowRun run;
    try {
        if (isLed && !leadIn) leadIn = leadInTo(window, variant.asked);
        engine::Simulation simulation = begin(window, variant);
        if (isLed) follow(*leadIn, simulation);
        run = timeFrames(window.scene, simulation, window.firstFrame, window.lastFrame, secondsLimit);
        if (isLed) charge(run, leadIn->trialShare);
        run.particles = std::move(simulation.particles);
    } catch (const engine::InstabilityError& error) {  // of the lead-in
        run.ending = Ending::unstable;
        run.failureMessage = error.what();
    }
    run.variant = variant;
    run.leadIn = std::move(leadIn);
    return run;
}

}  // namespace studies
