// The paper's stepper: the forces on all particles, then the update of velocities and positions.
#include "engine/stepping/symplectic_euler.h"

#include "engine/core/exp_negative.h"
#include "engine/core/parallel.h"
#include "engine/forces/external_forces.h"
#include "engine/state/state_checks.h"
#include "engine/stepping/kick_drift.h"
#include "engine/stepping/population.h"
#include "engine/stepping/step_cache.h"
#include "engine/stepping/take_step.h"

namespace engine {

bool symplecticEulerStep(Simulation& simulation, double h) {
    Particles& particles = simulation.particles;
    ForceEvaluator& evaluator = simulation.cache->evaluator;
    evaluator.evaluatePairs(particles, particles.velocity, simulation.cache->forces, h);
    ++simulation.steps.forceEvaluations;
    const double decay = expNegative(simulation.setup.drag * h);
    simulation.cache->clearance.clear();
    const bool hasObstacles = !evaluator.forceField().obstacles.shapes.empty();
    const KickDrift step{.h = h,
                         .decay = decay,
                         .gravity = evaluator.forceField().gravity,
                         .forces = simulation.cache->forces,
                         .hasWeight = hasObstacles};
    return holdsInRanges(particles.count(), contactGrain(evaluator.forceField().obstacles),
                         [&](std::size_t begin, std::size_t end) {
                             // The forces are added in the order pairs, weight, obstacles; another order would change
                             // the last bits.
                             if (hasObstacles)
                                 addExternalForces(evaluator.forceField(), particles, particles.velocity, begin, end,
                                                   simulation.cache->forces);
                             return kickAndDrift(step, begin, end, particles);
                         });
}

void advanceInEqualSteps(Simulation& simulation, double time) {
    const double from = simulation.time;
    const double count = stepCount(time - from, simulation.setup.step);
    const double h = (time - from) / count;
    if (simulation.steps.count == 0) requireValid(simulation, h);  // the states after later steps are validated below
    for (double step = 0.0; step < count; step += 1.0) {
        simulation.time = from + step * h;
        if (simulation.beforeStep) simulation.beforeStep(simulation);
        emitDue(simulation);
        const bool areAllValid = symplecticEulerStep(simulation, h);
        record(simulation.steps, h, StepLimit::fixed, simulation.stepper);
        if (!areAllValid) requireValid(simulation, h);
    }
    simulation.time = time;
    emitDue(simulation);
}

}  // namespace engine
