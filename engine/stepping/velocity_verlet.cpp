// Velocity Verlet with one force evaluation per step: the forces at the end of a step are kept for the start of the
// next.
#include "engine/stepping/velocity_verlet.h"

#include <algorithm>
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

/// Evaluates the forces of pairs and gravity and stores them in the step cache; returns the pair energy, J.
double evaluateForces(Simulation& simulation, const std::vector<Vec3>& velocities, double h) {
    ++simulation.steps.forceEvaluations;
    return simulation.cache->evaluator.evaluateFree(simulation.particles, velocities, simulation.cache->forces, h);
}

/// Change of a particle's velocity by half a kick with this force (N), m/s.
Vec3 halfKick(const Particles& particles, std::size_t p, double h, const Vec3& force) {
    return 0.5 * h / particles.mass[p] * force;
}

}  // namespace

void velocityVerletStep(Simulation& simulation, double h, double lambda) {
    Particles& particles = simulation.particles;
    const bool hasDrag = simulation.setup.drag > 0.0;
    const double decay = expNegative(simulation.setup.drag * h);
    // The forces, and with them the neighbor list, must be current before contacts are chosen: whether a particle has
    // neighbors is read from the list, which must contain new particles.
    if (!simulation.cache->forcesCurrent) evaluateForces(simulation, particles.velocity, h);
    const double from = simulation.time;
    prepareDrift(simulation, h);
    std::vector<Vec3>& predicted = simulation.cache->predictedVelocities;
    // Forces depend on the velocities after the fields' second half, too, which is about the first.
    const std::vector<Vec3>& fieldChanges = simulation.cache->fieldChanges;
    const auto changeByFields = [&](std::size_t p) { return Vec3((2.0 * lambda - 1.0) * fieldChanges[p]); };
    predicted.resize(particles.count());
    inParallel(particles.count(), contactGrain(simulation.setup.obstacles), [&](std::size_t p) {
        Vec3& velocity = particles.velocity[p];
        const Vec3 contacts = chooseSweptContact(simulation, p, h);
        const Vec3 change = halfKick(particles, p, h, simulation.cache->forces[p] + contacts);
        velocity += change;
        drift(simulation, p, from, hasDrag ? 0.5 * h : h);
        if (hasDrag) {
            velocity *= decay;
            drift(simulation, p, from + 0.5 * h, 0.5 * h);
        }
        predicted[p] = velocity + (2.0 * lambda - 1.0) * change;
        if (!fieldChanges.empty()) predicted[p] += changeByFields(p);
    });
    recordHeld(simulation);
    if (!isValid(simulation)) return markInvalid(simulation);
    const double pairEnergy = evaluateForces(simulation, predicted, h);
    // Leapfrog predicts no part of the second half of the kick, of which gravity causes no error: a particle that falls
    // is without error if this is left out, and one that rests if it is not.
    const Vec3 unpredictedFall = (1.0 - lambda) * h * simulation.setup.gravity;
    // The second half of the kick, and what is summed after it, in one loop: energies, the squares of the differences
    // between velocity and prediction, in (radii per second)^2.
    const auto [kinetic, potential, errorSqSum] =
        exactSums<3>(*simulation.ranks, particles.count(), [&](std::size_t p) {
            const ContactSums contacts = resolvedContacts(simulation, p, predicted[p], from + h, 0.5 * h);
            particles.velocity[p] += halfKick(particles, p, h, simulation.cache->forces[p] + contacts.force);
            const double radius = particles.radius[p];
            Vec3 missing = particles.velocity[p] - predicted[p];
            if (!fieldChanges.empty()) missing += changeByFields(p);
            const double errorSq =
                std::min(squaredLength(missing), squaredLength(missing - unpredictedFall)) / (radius * radius);
            const ParticleEnergy energy = particleEnergy(simulation, p, contacts.energy);
            return std::array{energy.kinetic, energy.potential, errorSq};
        });
    simulation.cache->forcesCurrent = true;
    simulation.cache->predictionError =
        std::sqrt(errorSqSum / static_cast<double>(std::max<std::uint64_t>(1, countOfAll(simulation))));
    addUpLoads(simulation);
    recordEnergy(simulation, {kinetic, potential}, pairEnergy);
}

}  // namespace engine
