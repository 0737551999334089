// Starts simulations, and chooses the loop of steps that advances them: equal, checked or automatic steps.
#include "engine/run/advance.h"

#include "engine/error_control/auto_stepper.h"
#include "engine/error_control/checked_steps.h"
#include "engine/error_control/equal_steps.h"
#include "engine/run/wall_depths.h"
#include "engine/stepping/free_groups.h"
#include "engine/stepping/population.h"
#include "engine/stepping/step_cache.h"

namespace engine {

Simulation start(const Setup& setup, const Ranks& ranks) {
    Simulation simulation;
    simulation.setup = setup;
    simulation.ranks = &ranks;
    Obstacles& obstacles = simulation.setup.obstacles;
    obstacles.index = indexOf(obstacles);
    recordInMotion(obstacles);
    if (!obstacles.areRecorded.empty()) simulation.loads.resize(obstacles.shapes.size());
    simulation.stepper = setup.stepper == StepperKind::automatic ? StepperKind::velocityVerlet : setup.stepper;
    simulation.cache->evaluator = ForceEvaluator(forceFieldOf(simulation.setup), setup.forces, setup.precision, ranks);
    simulation.particles = setup.initial;
    if (ranks.areMany())
        keepWhere(simulation.particles,
                  [&](std::size_t p) { return ranks.ownerOf(setup.initial.position[p]) == ranks.own(); });
    for (const Emitter& emitter : setup.emitters) simulation.emitters.push_back(initialState(emitter));
    emitDue(simulation);
    renewGroups(simulation);
    return simulation;
}

void advance(Simulation& simulation, double time) {
    if (time <= simulation.time) return;
    removeOutOfBounds(simulation);
    if (simulation.stepper == StepperKind::symplecticEuler)
        advanceInEqualSteps(simulation, time);
    else if (simulation.setup.stepper == StepperKind::automatic)
        advanceAutomatically(simulation, time);
    else
        advanceChecked(simulation, time, simulation.setup.step, StepLimit::fixed);
    renewGroups(simulation);
    recordWallDepths(simulation);
}

}  // namespace engine
