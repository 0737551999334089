// One evaluation a step: the forces at its end are those that the next one starts with.
#include "engine/velocity_verlet.h"

#include "engine/drift.h"
#include "engine/parallel.h"
#include "engine/soundness.h"
#include "engine/step_audit.h"

namespace engine {
namespace {

/// Returns the pair energy, J.
double evaluateForces(Simulation& simulation, const std::vector<Vec3>& velocities) {
    ++simulation.steps.forceEvaluations;
    return simulation.evaluator.evaluateFree(simulation.particles, velocities, simulation.forces);
}

/// Half a kick of pairs, gravity and slow contacts, which sees the given velocities.
void kick(Simulation& simulation, double h, const std::vector<Vec3>& seen) {
    Particles& particles = simulation.particles;
    std::vector<Vec3>& forces = simulation.kickForces;
    forces = simulation.forces;
    addContacts(simulation, seen, forces);
    for (std::size_t p = 0; p < particles.count(); ++p)
        particles.velocity[p] += 0.5 * h / particles.mass[p] * forces[p];
}

}  // namespace

void velocityVerletStep(Simulation& simulation, double h) {
    Particles& particles = simulation.particles;
    chooseSwept(simulation, h);
    if (!simulation.forcesCurrent) evaluateForces(simulation, particles.velocity);
    kick(simulation, h, particles.velocity);
    if (simulation.setup.drag == 0.0) {
        drift(simulation, h);
    } else {
        drift(simulation, 0.5 * h);
        applyDrag(simulation, h);
        drift(simulation, 0.5 * h);
    }
    if (!isSound(particles)) return noteUnsound(simulation);
    std::vector<Vec3>& predicted = simulation.predictedVelocities;
    predicted.resize(particles.count());
    for (std::size_t p = 0; p < particles.count(); ++p)
        predicted[p] = particles.velocity[p] + 0.5 * h / particles.mass[p] * simulation.kickForces[p];
    const double pairEnergy = evaluateForces(simulation, predicted);
    kick(simulation, h, predicted);
    simulation.forcesCurrent = true;
    noteEnergy(simulation, particles.velocity, pairEnergy);
}

}  // namespace engine
