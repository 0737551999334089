// The forces on all particles, then the update of velocities and positions.
#include "engine/stepping/symplectic_euler.h"

#include "engine/core/exp_negative.h"
#include "engine/core/parallel.h"
#include "engine/forces/external_forces.h"
#include "engine/obstacles/barriers.h"
#include "engine/state/probe.h"
#include "engine/state/state_checks.h"
#include "engine/stepping/drift.h"
#include "engine/stepping/kick_drift.h"
#include "engine/stepping/obstacle_loads.h"
#include "engine/stepping/step_cache.h"

namespace engine {
namespace {

/// A step of particles begin to end - 1 among scaled walls, from the forces between particles. Returns whether the new
/// positions and velocities are valid.
bool stepAmongScaledWalls(Simulation& simulation, double h, double decay, std::size_t begin, std::size_t end) {
    const Setup& setup = simulation.setup;
    Particles& particles = simulation.particles;
    LoadRecorder recorder(simulation);
    ContactLoads* const loads = recorder.list();
    bool areValid = true;
    for (std::size_t p = begin; p < end; ++p) {
        Probe particle = probeOf(setup.materials, particles, p, particles.velocity[p], simulation.time);
        const Vec3 force = simulation.cache->forces[p] + particle.mass * setup.gravity +
                           sumContacts(setup.obstacles, particle, loads, h).force;
        particle.velocity = decay * Vec3(particle.velocity + h / particle.mass * force);
        const int hits = moveAmongBarriers(setup.obstacles, particle, h, Arrival::slides, loads);
        simulation.cache->held[p] = static_cast<std::uint8_t>(hits);
        particles.position[p] = particle.position;
        particles.velocity[p] = particle.velocity;
        areValid &= isValid(particle.position, particle.velocity);
    }
    return areValid;
}

}  // namespace

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
    const bool hasScaledWalls = hasObstacles && evaluator.forceField().obstacles.wall == WallLaw::scaled;
    if (hasScaledWalls) simulation.cache->held.resize(particles.count());
    place(simulation.setup.obstacles, simulation.time, simulation.time + h);
    const bool areValid = holdsInRanges(particles.count(), contactGrain(evaluator.forceField().obstacles),
                                        [&](std::size_t begin, std::size_t end) {
                                            if (hasScaledWalls)
                                                return stepAmongScaledWalls(simulation, h, decay, begin, end);
                                            // The forces are added in the order pairs, weight, obstacles; another order
                                            // would change the last bits.
                                            if (hasObstacles)
                                                addExternalForces(evaluator.forceField(), particles, particles.velocity,
                                                                  begin, end, simulation.cache->forces);
                                            return kickAndDrift(step, begin, end, particles);
                                        });
    if (hasScaledWalls) recordHeld(simulation);
    return holdsOnAll(*simulation.ranks, areValid);
}

}  // namespace engine
