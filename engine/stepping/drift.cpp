// Every particle on its own.
#include "engine/stepping/drift.h"

#include <cmath>
#include <limits>

#include "engine/core/parallel.h"
#include "engine/law/obstacle_surfaces.h"
#include "engine/stepping/step_cache.h"
#include "engine/stepping/swept_contact.h"

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

constexpr std::uint32_t kNobody = std::numeric_limits<std::uint32_t>::max();

constexpr double kUnknown = -std::numeric_limits<double>::infinity();

/// Share of a radius by which a clearance is taken too small: far above what roundings add up to.
constexpr double kMargin = 1e-3;

}  // namespace

bool isClear(const Simulation& simulation, std::size_t p) {
    return p < simulation.cache->clearance.size() && simulation.cache->clearance[p] >= 0.0;
}

void prepareDrift(Simulation& simulation) {
    simulation.cache->evaluator
        .invalidateDisplacementBound();  // each particle goes its own way now, maybe before any evaluation
    if (simulation.setup.obstacles.shapes.empty()) return;
    simulation.cache->swept.resize(simulation.particles.count());
    simulation.cache->clearance.resize(simulation.particles.count(), kUnknown);
    simulation.cache->cachedNeighbors.resize(simulation.particles.count(), kNobody);
    copy(simulation.particles.position, simulation.cache->startPositions);
    // Of these very particles: the evaluator knows that of the last evaluation, which a run gone on with has not made.
    simulation.cache->startCutoff = termsFor(simulation.cache->evaluator.law(), simulation.particles).cutoff;
    // Verlet has the forces of the start, and with them its list, where forces need one.
    simulation.cache->startIsListed =
        (isVerlet(simulation.stepper) && simulation.cache->evaluator.needsList()) ||
        covers(simulation.cache->evaluator.list(), simulation.cache->startPositions, simulation.cache->startCutoff);
}

Vec3 chooseSwept(Simulation& simulation, std::size_t p, double h) {
    const Obstacles& obstacles = simulation.setup.obstacles;
    if (obstacles.shapes.empty()) return Vec3::Zero();
    simulation.cache->swept[p] = 0;
    const double way = h * std::sqrt(squaredLength(simulation.particles.velocity[p]));
    if (way <= simulation.cache->clearance[p]) return Vec3::Zero();
    const Flight flight = flightOf(simulation, p);
    const Contacts contacts = contactsAhead(obstacles, flight, h, isVerlet(simulation.stepper));
    simulation.cache->clearance[p] = contacts.gap - kMargin * flight.radius;
    // Alone, a particle feels only the obstacle, and the sweep is as good as exact. In company its contact is part of
    // what the whole heap does.
    const auto hasNoNeighborWithin = [&] {
        return simulation.cache->startIsListed && simulation.cache->evaluator.hasNoNeighborWithin(
                                                      simulation.cache->startPositions, simulation.cache->startCutoff,
                                                      p, simulation.cache->cachedNeighbors[p]);
    };
    if (!contacts.needsSweep && !(way > contacts.gap && hasNoNeighborWithin())) return contacts.force;
    simulation.cache->swept[p] = 1;
    return Vec3::Zero();
}

void driftSwept(Simulation& simulation, std::size_t p, double h) {
    Flight flight = flightOf(simulation, p);
    fly(simulation.setup.obstacles, flight, h);
    simulation.particles.position[p] = flight.position;
    simulation.particles.velocity[p] = flight.velocity;
    simulation.cache->clearance[p] = kUnknown;
}

Vec3 slowContactForce(const Simulation& simulation, std::size_t p, const Vec3& velocity) {
    const Obstacles& obstacles = simulation.setup.obstacles;
    if (obstacles.shapes.empty() || simulation.cache->swept[p] || isClear(simulation, p)) return Vec3::Zero();
    return contactForce(obstacles, probeOf(simulation, p, velocity));
}

ContactAnswer slowContact(const Simulation& simulation, std::size_t p, const Vec3& velocity) {
    const Obstacles& obstacles = simulation.setup.obstacles;
    if (obstacles.shapes.empty() || isClear(simulation, p)) return {};
    ContactAnswer answer = contactForceAndEnergy(obstacles, probeOf(simulation, p, velocity));
    if (simulation.cache->swept[p]) answer.force = Vec3::Zero();
    return answer;
}

void addContacts(const Simulation& simulation, double h, PairMatrix& matrix) {
    const Particles& particles = simulation.particles;
    const Obstacles& obstacles = simulation.setup.obstacles;
    const MatrixWeights weights{0.5 * h, 0.25 * h * h};
    matrix.own.resize(obstacles.shapes.empty() ? 0 : particles.count());
    const std::vector<std::uint32_t>& order = simulation.cache->evaluator.order();
    inParallel(matrix.own.size(), contactGrain(obstacles), [&](std::size_t place) {
        matrix.own[place] = Matrix3::Zero();
        const std::size_t p = order[place];
        if (simulation.cache->swept[p] || isClear(simulation, p)) return;
        const Probe probe = probeOf(simulation, p, particles.velocity[p]);
        forEachTouched(obstacles, probe.position, probe.radius, [&](const Surface& surface) {
            const Contact contact = contactWith(surface, obstacles.law, probe);
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
