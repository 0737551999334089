// Contacts of particles with obstacles: found at the start of a step, then applied as a force or along the particle's
// path.
#include "engine/stepping/drift.h"

#include <cmath>
#include <limits>
#include <numeric>

#include "engine/core/parallel.h"
#include "engine/obstacles/barriers.h"
#include "engine/obstacles/contact.h"
#include "engine/obstacles/swept_contact.h"
#include "engine/state/probe.h"
#include "engine/stepping/obstacle_loads.h"
#include "engine/stepping/step_cache.h"

namespace engine {
namespace {

Probe probeOf(const Simulation& simulation, std::size_t p, const Vec3& velocity, double time) {
    return probeOf(simulation.setup.materials, simulation.particles, p, velocity, time);
}

Probe probeOf(const Simulation& simulation, std::size_t p, double time) {
    return probeOf(simulation, p, simulation.particles.velocity[p], time);
}

/// Counts how often barriers have held a particle in this step; one that is held more than 255 times counts as 255.
void countHeld(Simulation& simulation, std::size_t p, int hits) {
    std::uint8_t& held = simulation.cache->held[p];
    held = static_cast<std::uint8_t>(std::min(255, held + hits));
}

constexpr std::uint32_t kNoNeighbor = std::numeric_limits<std::uint32_t>::max();

/// Clearance (distance from obstacles) of a particle about which nothing is known, m.
constexpr double kUnknown = -std::numeric_limits<double>::infinity();

/// Share of the particle's radius by which its clearance from obstacles is reduced for safety. Chosen: far above the
/// sum of all rounding errors.
constexpr double kMargin = 1e-3;

/// Adds damping and stiffness of a contact to the matrix of an implicit step of h seconds, kg.
void addToMatrix(const Surface& surface, const Contact& contact, const Probe& probe, double h, Matrix3& matrix) {
    const MatrixWeights weights{0.5 * h, 0.25 * h * h};
    const double along = weights.damping * dampingAlong(contact) + weights.stiffness * stiffnessAlong(contact);
    const Matrix3 projection = surface.normal * surface.normal.transpose();
    matrix += along * projection;
    if (contact.friction == 0.0) return;
    const Vec3 slip = slipVelocity(relativeVelocity(probe, surface), surface.normal);
    const double across = slipDamping(contact.friction, pressureForce(contact), squaredLength(slip));
    matrix += weights.damping * across * (Matrix3::Identity() - projection);
}

}  // namespace

bool isClearOfObstacles(const Simulation& simulation, std::size_t p) {
    return p < simulation.cache->clearance.size() && simulation.cache->clearance[p] >= 0.0;
}

void prepareDrift(Simulation& simulation, double h) {
    StepCache& cache = *simulation.cache;
    Obstacles& obstacles = simulation.setup.obstacles;
    if (obstacles.shapes.empty()) return;
    place(obstacles, simulation.time, simulation.time + h);
    cache.surfaceSpeed = fastestSurface(obstacles, simulation.time, simulation.time + h);
    const Particles& particles = simulation.particles;
    cache.swept.resize(particles.count());
    cache.held.assign(particles.count(), 0);
    cache.clearance.resize(particles.count(), kUnknown);
    cache.cachedNeighbors.resize(particles.count(), kNoNeighbor);
    copy(particles.position, cache.startPositions);
    // The cutoff is computed from the present particles. The cutoff of the last force evaluation would not do, since a
    // resumed run has not made that evaluation.
    const auto cutoff = [&] { return termsFor(cache.evaluator.forceField(), particles, *simulation.ranks).cutoff; };
    // A Verlet stepper has evaluated the forces at the start of the step, and with them has brought the neighbor list
    // up to date if the force method uses one.
    cache.startIsListed =
        (isVerlet(simulation.stepper) && cache.evaluator.needsList()) ||
        covers(cache.evaluator.list(), cache.startPositions, cutoff(), cache.evaluator.groups(), *simulation.ranks);
    if (cache.startIsListed && !isVerlet(simulation.stepper)) cache.evaluator.fetchGhosts(particles);
}

Vec3 chooseSweptContact(Simulation& simulation, std::size_t p, double h) {
    const Obstacles& obstacles = simulation.setup.obstacles;
    if (obstacles.shapes.empty()) return Vec3::Zero();
    StepCache& cache = *simulation.cache;
    cache.swept[p] = 0;
    const double speed = std::sqrt(squaredLength(simulation.particles.velocity[p])) + cache.surfaceSpeed;
    if (h * speed <= cache.clearance[p]) return Vec3::Zero();
    const Probe particle = probeOf(simulation, p, simulation.time);
    const bool isExplicit = isVerlet(simulation.stepper);
    LoadRecorder recorder(simulation);
    const Contacts contacts =
        contactsInStep(obstacles, particle, h, isExplicit, isExplicit ? recorder.list() : nullptr);
    cache.clearance[p] = contacts.gap - kMargin * particle.radius;
    // The contact of a particle without neighbors is swept, which means integrated along its path by small steps: only
    // the obstacle acts on it, so that this is nearly exact. With neighbors, the contact is coupled to the forces in
    // the heap around the particle.
    const auto hasNoNeighbor = [&] {
        return cache.startIsListed && cache.evaluator.hasNoNeighbor(cache.startPositions, simulation.particles.radius,
                                                                    p, cache.cachedNeighbors[p]);
    };
    if (!contacts.needsSweep && !(contacts.mayTouch && hasNoNeighbor())) return contacts.force;
    cache.swept[p] = 1;
    recorder.clear();
    return Vec3::Zero();
}

bool hadFreePath(const Simulation& simulation, std::size_t p, const Vec3& start) {
    const Obstacles& obstacles = simulation.setup.obstacles;
    if (obstacles.shapes.empty() || isClearOfObstacles(simulation, p)) return true;
    if (simulation.cache->swept[p]) return false;  // swept contacts are those in a particle's way
    // Where they were in the meantime is not known here.
    if (areInMotion(obstacles)) return false;
    Probe particle = probeOf(simulation, p, simulation.time);
    particle.position = start;
    const double gap = contactsInStep(obstacles, particle, 0.0, false).gap;
    // A clearance is smaller by a whole margin, so that a particle which is clear of obstacles also passes this test.
    const double margin = 0.5 * kMargin * particle.radius;
    return std::sqrt(squaredLength(simulation.particles.position[p] - start)) <= gap - margin;
}

void driftSwept(Simulation& simulation, std::size_t p, double from, double h) {
    Probe particle = probeOf(simulation, p, from);
    LoadRecorder recorder(simulation);
    countHeld(simulation, p, advanceThroughContacts(simulation.setup.obstacles, particle, h, recorder.list()));
    simulation.particles.position[p] = particle.position;
    simulation.particles.velocity[p] = particle.velocity;
    simulation.cache->clearance[p] = kUnknown;
}

void driftToBarriers(Simulation& simulation, std::size_t p, double from, double h) {
    Probe particle = probeOf(simulation, p, from);
    LoadRecorder recorder(simulation);
    countHeld(simulation, p,
              moveAmongBarriers(simulation.setup.obstacles, particle, h, Arrival::slides, recorder.list()));
    simulation.particles.position[p] = particle.position;
    simulation.particles.velocity[p] = particle.velocity;
}

void recordHeld(Simulation& simulation) {
    if (simulation.setup.obstacles.wall == WallLaw::paper) return;
    const std::vector<std::uint8_t>& held = simulation.cache->held;
    simulation.steps.held = std::accumulate(held.begin(), held.end(), simulation.steps.held);
}

ContactSums resolvedContacts(Simulation& simulation, std::size_t p, const Vec3& velocity, double time, double seconds) {
    const Obstacles& obstacles = simulation.setup.obstacles;
    if (obstacles.shapes.empty() || isClearOfObstacles(simulation, p)) return {};
    const bool isSwept = simulation.cache->swept[p] != 0;
    LoadRecorder recorder(simulation);
    ContactLoads* const loads = isSwept || seconds == 0.0 ? nullptr : recorder.list();
    ContactSums contacts = sumContacts(obstacles, probeOf(simulation, p, velocity, time), loads, seconds);
    if (isSwept) contacts.force = Vec3::Zero();
    return contacts;
}

void recordHalfKick(Simulation& simulation, std::size_t p, const Vec3& velocity, const Vec3& change, double time,
                    double h) {
    const Obstacles& obstacles = simulation.setup.obstacles;
    if (simulation.cache->swept[p] || isClearOfObstacles(simulation, p)) return;
    LoadRecorder recorder(simulation);
    ContactLoads& loads = *recorder.list();
    const Probe probe = probeOf(simulation, p, velocity, time);
    forEachTouched(obstacles, probe.position, time, probe.radius, [&](const Surface& surface) {
        if (!isRecorded(obstacles, surface.obstacle)) return;
        const Contact contact = contactWith(surface, obstacles, probe);
        Vec3 force = Vec3::Zero();
        addForce(surface, contact, probe, force);
        Matrix3 matrix = Matrix3::Zero();
        addToMatrix(surface, contact, probe, h, matrix);
        recordLoad(surface, 0.5 * h * force - matrix * change, obstacles, probe, loads);
    });
}

void addContacts(const Simulation& simulation, double time, double h, PairMatrix& matrix) {
    const Obstacles& obstacles = simulation.setup.obstacles;
    const std::vector<std::uint32_t>& order = simulation.cache->evaluator.order();
    matrix.own.resize(obstacles.shapes.empty() ? 0 : order.size());
    inParallel(matrix.own.size(), contactGrain(obstacles), [&](std::size_t place) {
        matrix.own[place] = Matrix3::Zero();
        const std::size_t p = order[place];
        if (p == kGhost || simulation.cache->swept[p] || isClearOfObstacles(simulation, p)) return;
        const Probe probe = probeOf(simulation, p, time);
        forEachTouched(obstacles, probe.position, time, probe.radius, [&](const Surface& surface) {
            addToMatrix(surface, contactWith(surface, obstacles, probe), probe, h, matrix.own[place]);
        });
    });
}

}  // namespace engine
