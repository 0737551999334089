// Births, a step, a verdict.
#include "engine/audited_steps.h"

#include <algorithm>
#include <cmath>

#include "engine/soundness.h"
#include "engine/step_audit.h"
#include "engine/steppers.h"

namespace engine {
namespace {

/// Chosen: good steps in a row before a longer one is tried again.
constexpr int kPatience = 8;

/// Chosen: shorter than anything that a motion within the world's limits asks for, s.
constexpr double kShortest = 1e-12;

/// The energy that the first step is judged by; the forces come with it.
void establishEnergy(Simulation& simulation) {
    if (simulation.energy) return;
    requireSound(simulation, 0.0);
    Particles& particles = simulation.particles;
    const double pairEnergy = simulation.evaluator.evaluateFree(particles, particles.velocity, simulation.forces);
    ++simulation.steps.forceEvaluations;
    simulation.forcesCurrent = true;
    noteEnergy(simulation, particles.velocity, pairEnergy);
}

void record(StepStatistics& steps, double h, StepLimit limit) {
    steps.shortest = steps.count == 0 ? h : std::min(steps.shortest, h);
    steps.longest = std::max(steps.longest, h);
    ++steps.count;
    ++steps.limitedBy[static_cast<std::size_t>(limit)];
}

}  // namespace

void advanceAudited(Simulation& simulation, double time, double longest, StepLimit why) {
    BeforeStep before;
    int accepted = 0;
    giveBirth(simulation);
    establishEnergy(simulation);
    while (simulation.time < time) {
        const StepRestriction& restriction = simulation.restriction;
        const double remaining = time - simulation.time;
        const double allowed = std::min(longest, restriction.seconds);
        // The smallest whole number of steps; the slack keeps 0.02 s at steps of 0.01 s from becoming three.
        const double count = std::max(1.0, std::ceil(remaining / allowed * (1.0 - 1e-9)));
        const double h = remaining / count;
        keep(simulation, before);
        takeStep(simulation, h);
        if (const auto reason = objection(simulation, before)) {
            if (h < kShortest) reportInstability(simulation, h);
            takeBack(simulation, before);
            ++simulation.steps.rejected;
            simulation.restriction = {0.5 * h, *reason};
            accepted = 0;
            continue;
        }
        record(simulation.steps, h, restriction.seconds < longest ? restriction.reason : why);
        simulation.time = count == 1.0 ? time : simulation.time + h;
        giveBirth(simulation);
        if (++accepted % kPatience == 0) simulation.restriction.seconds *= 2.0;
    }
}

}  // namespace engine
