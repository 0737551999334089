// Every particle on its own, shared out over the threads.
#include "engine/drift.h"

#include "engine/contact_drift.h"
#include "engine/decay.h"
#include "engine/parallel.h"
#include "engine/surfaces.h"

namespace engine {
namespace {

constexpr std::size_t kContactGrain = 128;  // chosen: a contact takes some microseconds

const Material& materialOf(const Simulation& simulation, std::size_t p) {
    return simulation.setup.materials[simulation.particles.material[p]];
}

Probe probeOf(const Simulation& simulation, std::size_t p, const Vec3& velocity) {
    const Material& material = materialOf(simulation, p);
    return {simulation.particles.position[p], velocity, simulation.particles.radius[p], material.dampingReach,
            material.friction};
}

Flight flightOf(const Simulation& simulation, std::size_t p) {
    const Particles& particles = simulation.particles;
    return {particles.position[p],
            particles.velocity[p],
            particles.mass[p],
            particles.radius[p],
            materialOf(simulation, p).dampingReach,
            materialOf(simulation, p).friction};
}

/// Calls body(p) for every particle that is not swept, if there is anything to touch.
template <class Body>
void forEachUnswept(const Simulation& simulation, const Body& body) {
    if (simulation.setup.scenery.colliders.empty()) return;
    inParallel(simulation.particles.count(), kContactGrain, [&](std::size_t p) {
        if (!simulation.swept[p]) body(p);
    });
}

}  // namespace

void chooseSwept(Simulation& simulation, double h) {
    const Scenery& scenery = simulation.setup.scenery;
    if (scenery.colliders.empty()) return;
    const bool isExplicit = simulation.stepper == StepperKind::velocityVerlet;
    simulation.swept.resize(simulation.particles.count());
    inParallel(simulation.particles.count(), kContactGrain, [&](std::size_t p) {
        // Alone, a particle feels only the obstacle, and the sweep is as good as exact. In company its contact is part
        // of what the whole heap does.
        const Flight flight = flightOf(simulation, p);
        const bool isSwept =
            simulation.evaluator.isAlone(p) ? mayTouch(scenery, flight, h) : needsSweep(scenery, flight, h, isExplicit);
        simulation.swept[p] = isSwept ? 1 : 0;
    });
}

void drift(Simulation& simulation, double h) {
    Particles& particles = simulation.particles;
    const Scenery& scenery = simulation.setup.scenery;
    const bool canMeet = !scenery.colliders.empty();
    inParallel(particles.count(), kContactGrain, [&](std::size_t p) {
        if (!canMeet || !simulation.swept[p]) {
            particles.position[p] += h * particles.velocity[p];
            return;
        }
        Flight flight = flightOf(simulation, p);
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

void addContacts(const Simulation& simulation, const std::vector<Vec3>& velocities, std::vector<Vec3>& forces) {
    forEachUnswept(simulation, [&](std::size_t p) {
        forces[p] += contactForce(simulation.setup.scenery, probeOf(simulation, p, velocities[p]));
    });
}

void addContacts(const Simulation& simulation, double h, PairMatrix& matrix) {
    const Particles& particles = simulation.particles;
    const Scenery& scenery = simulation.setup.scenery;
    const MatrixWeights weights{0.5 * h, 0.25 * h * h};
    matrix.own.clear();
    if (scenery.colliders.empty()) return;
    matrix.own.assign(particles.count(), Matrix3::Zero());
    const std::vector<std::uint32_t>& order = simulation.evaluator.order();
    inParallel(order.size(), kContactGrain, [&](std::size_t place) {
        const std::size_t p = order[place];
        if (simulation.swept[p]) return;
        const Probe probe = probeOf(simulation, p, particles.velocity[p]);
        forEachSurface(scenery, probe.position, [&](const Surface& surface) {
            if (surface.height >= probe.radius) return;
            const Contact contact = contactWith(surface, scenery.law, probe);
            const double along = weights.damping * dampingAlong(contact) + weights.stiffness * stiffnessAlong(contact);
            const Matrix3 projection = surface.normal * surface.normal.transpose();
            matrix.own[place] += along * projection;
            if (probe.friction == 0.0) return;
            const Vec3 slip = probe.velocity - dot(probe.velocity, surface.normal) * surface.normal;
            const double across = slipDamping(probe.friction, normalForce(contact, 0.0), squaredLength(slip));
            matrix.own[place] += weights.damping * across * (Matrix3::Identity() - projection);
        });
    });
}

}  // namespace engine
