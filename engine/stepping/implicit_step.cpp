// The implicit step: assembles the matrix in the middle of the step, solves for the change of velocity, and applies it.
#include "engine/stepping/implicit_step.h"

#include <cmath>

#include "engine/core/exp_negative.h"
#include "engine/core/parallel.h"
#include "engine/ranks/exact_sums.h"
#include "engine/state/state_checks.h"
#include "engine/stepping/drift.h"
#include "engine/stepping/obstacle_loads.h"
#include "engine/stepping/step_audit.h"
#include "engine/stepping/step_cache.h"

namespace engine {
namespace {

/// Solves the linear system for d, half the change of velocity over the step, with the particles in the order of the
/// matrix.
void solveForChange(Simulation& simulation, double h) {
    ImplicitScratch& scratch = simulation.cache->implicit;
    const std::vector<std::uint32_t>& order = simulation.cache->evaluator.order();
    scratch.rightHandSide.resize(order.size());
    const Vec3 fall = 0.5 * h * simulation.setup.gravity;
    inParallel(order.size(), kParticleGrain, [&](std::size_t place) {
        if (order[place] == kGhost) {
            scratch.rightHandSide[place] = Vec3::Zero();
            return;
        }
        scratch.rightHandSide[place] =
            0.5 * h * simulation.cache->forces[order[place]] - scratch.matrix.mass[place] * fall;
        if (!scratch.matrix.own.empty()) scratch.rightHandSide[place] -= scratch.matrix.own[place] * fall;
    });
    const double mass = exactSum(*simulation.ranks, order.size(), [&](std::size_t place) {
        return order[place] == kGhost ? 0.0 : scratch.matrix.mass[place];
    });
    const Tolerance tolerance = {simulation.setup.solverTolerance,
                                 0.5 * h * simulation.cache->toleratedAcceleration * std::sqrt(mass)};
    const int products = solve(scratch.matrix, scratch.rightHandSide, tolerance, scratch.change, scratch.solver);
    inParallel(order.size(), kParticleGrain, [&](std::size_t place) { scratch.change[place] += fall; });
    simulation.steps.products += static_cast<std::uint64_t>(products);
}

/// Records the loads of half a kick at the contacts with obstacles.
/// @param hadChange  whether half the change has been added to the velocities
void recordHalfKicks(Simulation& simulation, double h, bool hadChange) {
    if (simulation.setup.obstacles.areRecorded.empty()) return;
    const std::vector<std::uint32_t>& order = simulation.cache->evaluator.order();
    const std::vector<Vec3>& change = simulation.cache->implicit.change;
    const double middle = simulation.time + 0.5 * h;
    inParallel(order.size(), contactGrain(simulation.setup.obstacles), [&](std::size_t place) {
        const std::size_t p = order[place];
        if (p == kGhost) return;
        const Vec3& velocity = simulation.particles.velocity[p];
        const Vec3 before = hadChange ? Vec3(velocity - change[place]) : velocity;
        recordHalfKick(simulation, p, before, change[place], middle, h);
    });
    addUpLoads(simulation);
}

/// Changes the velocities by the forces in the middle of a step of h seconds, and records the energy there.
void kick(Simulation& simulation, double h, const MatrixWeights& weights) {
    Particles& particles = simulation.particles;
    const double middle = simulation.time + 0.5 * h;
    const double pairEnergy = simulation.cache->evaluator.assemble(particles, weights, simulation.cache->forces,
                                                                   simulation.cache->implicit.matrix, h);
    ++simulation.steps.forceEvaluations;
    ++simulation.steps.matrices;
    inParallel(particles.count(), contactGrain(simulation.setup.obstacles), [&](std::size_t p) {
        simulation.cache->forces[p] += resolvedContacts(simulation, p, particles.velocity[p], middle, 0.0).force;
    });
    addContacts(simulation, middle, h, simulation.cache->implicit.matrix);
    solveForChange(simulation, h);
    const std::vector<std::uint32_t>& order = simulation.cache->evaluator.order();
    const std::vector<Vec3>& change = simulation.cache->implicit.change;
    const auto addChange = [&] {
        inParallel(order.size(), kParticleGrain, [&](std::size_t place) {
            if (order[place] != kGhost) particles.velocity[order[place]] += change[place];
        });
    };
    recordHalfKicks(simulation, h, false);
    addChange();
    recordEnergy(simulation, pairEnergy, middle);  // at this point the velocities are those in the middle of the step
    recordHalfKicks(simulation, h, true);
    addChange();
}

}  // namespace

void implicitStep(Simulation& simulation, double h, const MatrixWeights& weights) {
    Particles& particles = simulation.particles;
    const double decay = expNegative(simulation.setup.drag * (0.5 * h));
    const std::size_t grain = contactGrain(simulation.setup.obstacles);
    const double from = simulation.time;
    prepareDrift(simulation, h);
    place(simulation.setup.obstacles, from, from + 0.5 * h);
    inParallel(particles.count(), grain, [&](std::size_t p) {
        chooseSweptContact(simulation, p, h);  // the force that it returns is not needed
        drift(simulation, p, from, 0.5 * h);
        particles.velocity[p] *= decay;
    });
    if (!isValid(simulation)) return markInvalid(simulation);
    kick(simulation, h, weights);
    place(simulation.setup.obstacles, from + 0.5 * h, from + h);
    inParallel(particles.count(), grain, [&](std::size_t p) {
        particles.velocity[p] *= decay;
        drift(simulation, p, from + 0.5 * h, 0.5 * h);
    });
    addUpLoads(simulation);
    recordHeld(simulation);
    simulation.cache->forcesCurrent = false;
}

}  // namespace engine
