// Every particle on its own, shared out over the threads.
#include "engine/drift.h"

#include "engine/contact_drift.h"
#include "engine/decay.h"
#include "engine/parallel.h"

namespace engine {

void drift(Simulation& simulation, double h) {
    Particles& particles = simulation.particles;
    const Scenery& scenery = simulation.setup.scenery;
    if (scenery.colliders.empty()) {
        inParallel(particles.count(), kParticleGrain,
                   [&](std::size_t p) { particles.position[p] += h * particles.velocity[p]; });
        return;
    }
    constexpr std::size_t kGrain = 128;  // chosen: a contact takes some microseconds
    inParallel(particles.count(), kGrain, [&](std::size_t p) {
        Flight flight{particles.position[p], particles.velocity[p], particles.mass[p], particles.radius[p],
                      simulation.setup.materials[particles.material[p]].dampingReach};
        fly(scenery, flight, h);
        particles.position[p] = flight.position;
        particles.velocity[p] = flight.velocity;
    });
}

void applyDrag(Simulation& simulation, double h) {
    if (simulation.setup.drag == 0.0) return;
    const double decay = decayFactor(simulation.setup.drag, h);
    for (Vec3& velocity : simulation.particles.velocity) velocity *= decay;
}

}  // namespace engine
