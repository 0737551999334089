// The run, seen whole: how a simulation starts, and how it gets to a point in time.
#include "engine/stepping/simulation.h"

#include <algorithm>
#include <cmath>

#include "engine/error_control/auto_stepper.h"
#include "engine/error_control/checked_steps.h"
#include "engine/stepping/population.h"
#include "engine/stepping/state_checks.h"
#include "engine/stepping/steppers.h"

namespace engine {
namespace {

void record(Simulation& simulation, double h) {
    StepStatistics& steps = simulation.steps;
    steps.shortest = steps.count == 0 ? h : std::min(steps.shortest, h);
    steps.longest = std::max(steps.longest, h);
    ++steps.count;
    ++steps.limitedBy[static_cast<std::size_t>(StepLimit::given)];
    ++steps.takenBy[static_cast<std::size_t>(simulation.stepper)];
}

/// The paper's way: equal steps, and what comes of them.
void advanceAsPrinted(Simulation& simulation, double time) {
    const double from = simulation.time;
    // The smallest whole number of steps; the slack keeps 0.02 s at steps of 0.01 s from becoming three.
    const double count = std::max(1.0, std::ceil((time - from) / simulation.setup.step * (1.0 - 1e-9)));
    const double h = (time - from) / count;
    if (simulation.steps.count == 0) requireSound(simulation, h);  // later on, the last step has been looked at
    for (double step = 0.0; step < count; step += 1.0) {
        simulation.time = from + step * h;
        giveBirth(simulation);
        const bool areAllSound = symplecticEulerStep(simulation, h);
        record(simulation, h);
        if (!areAllSound) requireSound(simulation, h);
    }
    simulation.time = time;
    giveBirth(simulation);
}

}  // namespace

Simulation start(const Setup& setup) {
    Simulation simulation;
    simulation.setup = setup;
    simulation.stepper = setup.stepper == StepperKind::automatic ? StepperKind::velocityVerlet : setup.stepper;
    simulation.evaluator =
        ForceEvaluator({setup.materials, setup.gravity, setup.scenery}, setup.forces, setup.precision);
    simulation.particles = setup.initial;
    for (const Emitter& emitter : setup.emitters) simulation.emitters.push_back(initialState(emitter));
    giveBirth(simulation);
    return simulation;
}

void advance(Simulation& simulation, double time) {
    if (time <= simulation.time) return;
    removeLeavers(simulation);
    if (simulation.stepper == StepperKind::symplecticEuler)
        advanceAsPrinted(simulation, time);
    else if (simulation.setup.stepper == StepperKind::automatic)
        advanceAutomatically(simulation, time);
    else
        advanceAudited(simulation, time, simulation.setup.step, StepLimit::given);
}

std::uint64_t largestCount(const Simulation& simulation) {
    return std::max<std::uint64_t>(simulation.mostBeforeDeaths, simulation.particles.count());
}

std::uint64_t birthCount(const Simulation& simulation) {
    std::uint64_t sum = 0;
    for (const EmitterState& state : simulation.emitters) sum += state.births;
    return sum;
}

std::uint64_t refusalCount(const Simulation& simulation) {
    std::uint64_t sum = 0;
    for (const EmitterState& state : simulation.emitters) sum += state.refusals;
    return sum;
}

}  // namespace engine
