// Every particle on its own.
#include "engine/drift.h"

#include <cmath>
#include <limits>

#include "engine/contact_drift.h"
#include "engine/surfaces.h"

namespace engine {
namespace {

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

constexpr double kUnknown = -std::numeric_limits<double>::infinity();

/// Share of a radius by which a clearance is taken too small: far above what roundings add up to.
constexpr double kMargin = 1e-3;

/// Whether a particle may be in the way (m) of an obstacle; measures its clearance where the one known is too small.
bool mayTouch(Simulation& simulation, const Flight& flight, std::size_t p, double way) {
    double& clearance = simulation.clearance[p];
    if (way <= clearance) return false;
    const double gap = gapAround(simulation.setup.scenery, flight);
    clearance = gap - kMargin * flight.radius;
    return way > gap;
}

}  // namespace

bool isClear(const Simulation& simulation, std::size_t p) {
    return p < simulation.clearance.size() && simulation.clearance[p] >= 0.0;
}

void prepareDrift(Simulation& simulation) {
    if (simulation.setup.scenery.colliders.empty()) return;
    simulation.swept.resize(simulation.particles.count());
    simulation.clearance.resize(simulation.particles.count(), kUnknown);
}

void chooseSwept(Simulation& simulation, std::size_t p, double h) {
    const Scenery& scenery = simulation.setup.scenery;
    if (scenery.colliders.empty()) return;
    const Flight flight = flightOf(simulation, p);
    const double way = h * std::sqrt(squaredLength(flight.velocity));
    const bool isExplicit = simulation.stepper == StepperKind::velocityVerlet;
    // Alone, a particle feels only the obstacle, and the sweep is as good as exact. In company its contact is part of
    // what the whole heap does.
    const bool isSwept = mayTouch(simulation, flight, p, way) &&
                         (simulation.evaluator.isAlone(p) || needsSweep(scenery, flight, h, isExplicit));
    simulation.swept[p] = isSwept ? 1 : 0;
}

void drift(Simulation& simulation, std::size_t p, double h) {
    Particles& particles = simulation.particles;
    const Scenery& scenery = simulation.setup.scenery;
    if (scenery.colliders.empty() || !simulation.swept[p]) {
        particles.position[p] += h * particles.velocity[p];
        if (!scenery.colliders.empty()) simulation.clearance[p] -= h * std::sqrt(squaredLength(particles.velocity[p]));
        return;
    }
    Flight flight = flightOf(simulation, p);
    fly(scenery, flight, h);
    particles.position[p] = flight.position;
    particles.velocity[p] = flight.velocity;
    simulation.clearance[p] = kUnknown;
}

Vec3 slowContactForce(const Simulation& simulation, std::size_t p, const Vec3& velocity) {
    const Scenery& scenery = simulation.setup.scenery;
    if (scenery.colliders.empty() || simulation.swept[p] || isClear(simulation, p)) return Vec3::Zero();
    return contactForce(scenery, probeOf(simulation, p, velocity));
}

void addContacts(const Simulation& simulation, double h, PairMatrix& matrix) {
    const Particles& particles = simulation.particles;
    const Scenery& scenery = simulation.setup.scenery;
    const MatrixWeights weights{0.5 * h, 0.25 * h * h};
    matrix.own.clear();
    if (scenery.colliders.empty()) return;
    matrix.own.assign(particles.count(), Matrix3::Zero());
    const std::vector<std::uint32_t>& order = simulation.evaluator.order();
    forEachParticle(simulation, [&](std::size_t place) {
        const std::size_t p = order[place];
        if (simulation.swept[p] || isClear(simulation, p)) return;
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
