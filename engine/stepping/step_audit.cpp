// The audit of time steps. Sums of energies are exact until they are rounded, so that whether a step is accepted does
// not depend on the numbers of threads and ranks.
#include "engine/stepping/step_audit.h"

#include <cmath>
#include <limits>

#include "engine/core/parallel.h"
#include "engine/ranks/exact_sums.h"
#include "engine/state/probe.h"
#include "engine/stepping/drift.h"
#include "engine/stepping/free_groups.h"

namespace engine {
namespace {

/// Speed that is added to the motion when the allowed energy gain is computed, in radii per second. Chosen: far below
/// any visible motion.
constexpr double kSlow = 0.1;

/// Relative rounding error of an energy. Derived: a thousand roundings of the energies whose difference is judged.
constexpr double kRounding = 1e-13;

/// Energy of a particle at the obstacles, which are where they are at a time (s), J.
double contactEnergyOf(const Simulation& simulation, std::size_t p, double time) {
    if (simulation.setup.obstacles.shapes.empty() || isClearOfObstacles(simulation, p)) return 0.0;
    const Particles& particles = simulation.particles;
    const Probe probe = probeOf(simulation.setup.materials, particles, p, Vec3::Zero(), time);
    return sumContacts(simulation.setup.obstacles, probe).energy;
}

/// Whether a step may move every particle by more than its radius: only where there is a single particle that cannot
/// have passed through an obstacle.
bool mayGoFar(const Simulation& simulation) {
    if (countOfAll(simulation) > 1) return false;
    return holdsOnAll(*simulation.ranks, simulation.particles.count() == 0 ||
                                             simulation.setup.obstacles.shapes.empty() ||
                                             simulation.cache->swept[0] != 0 || isClearOfObstacles(simulation, 0));
}

/// Whether a particle has moved by more than its radius; a NaN counts.
bool movedFar(const Simulation& simulation, const SavedState& saved, std::size_t p) {
    const Particles& particles = simulation.particles;
    return !(squaredLength(particles.position[p] - saved.position[p]) <= particles.radius[p] * particles.radius[p]);
}

/// Whether a particle has moved by at most its radius relative to its group, in free fall.
/// @param motions  of the groups, m
bool movedWithGroup(const Simulation& simulation, const SavedState& saved, const std::vector<Vec3>& motions,
                    std::size_t p) {
    if (!hadFreePath(simulation, p, saved.position[p])) return false;
    const Particles& particles = simulation.particles;
    const Vec3 common = motions[simulation.cache->evaluator.groups().of(p)];
    const Vec3 moved = particles.position[p] - saved.position[p];
    return squaredLength(moved - common) <= particles.radius[p] * particles.radius[p];  // false for a NaN
}

bool movedTooFar(const Simulation& simulation, const SavedState& saved) {
    if (mayGoFar(simulation)) return false;
    const auto holdsForAll = [&](const auto& holds) {
        const auto fails = [&](std::size_t p) { return holds(p) ? 0.0 : 1.0; };
        return holdsOnAll(*simulation.ranks, largestOver(simulation.particles.count(), fails) == 0.0);
    };
    if (holdsForAll([&](std::size_t p) { return !movedFar(simulation, saved, p); })) return false;
    if (!simulation.cache->evaluator.groups().exist()) return true;
    const std::vector<Vec3> motions = motionsOfGroups(simulation, saved.position);
    const bool areWithGroups = holdsForAll([&](std::size_t p) {
        return !movedFar(simulation, saved, p) || movedWithGroup(simulation, saved, motions, p);
    });
    return !areWithGroups || !haveStayedApart(simulation, saved.position);
}

/// Energy that the step from the saved state to the present one may have gained, J. The common motion of a group in
/// free fall adds what it has gained itself and rounding errors, and no share of its energy. It gains where an implicit
/// step knows the energy between two positions, and loses by drag; either would hide what goes wrong elsewhere.
double allowanceFor(const Simulation& simulation, const SavedState& saved) {
    double allowance = saved.allowance;
    const FarGroups& groups = simulation.cache->evaluator.groups();
    // Where groups have met, forces between them have changed their common motion. What fields add to it is in the
    // work.
    if (!groups.exist() || !simulation.setup.fields.empty() || !haveStayedApart(simulation, saved.position))
        return allowance;
    // Particles that were emitted since the groups were found act on group 0, but are not in its energy.
    const bool hasEmitted = !holdsOnAll(*simulation.ranks, simulation.particles.count() <= groups.groupOf.size());
    const std::vector<bool> areFree = groupsInFreeFall(simulation, saved.position);
    for (std::size_t group = hasEmitted ? 1 : 0; group < areFree.size(); ++group) {
        if (!areFree[group]) continue;
        const GroupEnergy& before = saved.groupEnergies[group];
        const GroupEnergy& now = simulation.cache->groupEnergies[group];
        allowance += (now.kinetic - before.kinetic) + (now.potential - before.potential);
        allowance += kRounding * (before.kinetic + std::abs(before.potential)) - kEnergyAllowance * before.kinetic;
    }
    return allowance;
}

}  // namespace

double energyAllowance(const Simulation& simulation) {
    const Particles& particles = simulation.particles;
    const double slow = exactSum(*simulation.ranks, particles.count(), [&](std::size_t p) {
        const double speed = kSlow * particles.radius[p];
        return 0.5 * particles.mass[p] * speed * speed;
    });
    return kEnergyAllowance * (simulation.cache->kinetic + slow) +
           kRounding * std::abs(simulation.cache->energy.value_or(0.0));
}

void recordEnergy(Simulation& simulation, const ParticleEnergy& own, double pairEnergy) {
    simulation.cache->kinetic = own.kinetic;
    simulation.cache->energy = own.kinetic + own.potential + pairEnergy;
    simulation.cache->groupEnergies = groupEnergies(simulation);
    simulation.cache->workAtEnergy = simulation.cache->work;
}

void recordEnergy(Simulation& simulation, double pairEnergy, double time) {
    const auto [kinetic, potential] = exactSums<2>(*simulation.ranks, simulation.particles.count(), [&](std::size_t p) {
        const ParticleEnergy energy = particleEnergy(simulation, p, contactEnergyOf(simulation, p, time));
        return std::array{energy.kinetic, energy.potential};
    });
    recordEnergy(simulation, {kinetic, potential}, pairEnergy);
}

void markInvalid(Simulation& simulation) {
    simulation.cache->energy = std::numeric_limits<double>::quiet_NaN();
}

void addEnergyOfEmitted(Simulation& simulation, const Particles& emitted, const LinkedCells& cells) {
    if (!simulation.cache->energy) return;
    const ForceField& field = simulation.cache->evaluator.forceField();
    const Particles& particles = simulation.particles;
    std::array<ExactSum, 3> sums;  // kinetic and other energy of the particles, energy of their pairs
    for (std::size_t p = 0; p < particles.count(); ++p) {
        if (particles.id[p] < emitted.id.front()) continue;
        const ParticleEnergy own = particleEnergy(simulation, p, contactEnergyOf(simulation, p, simulation.time));
        sums[0].add(own.kinetic);
        sums[1].add(own.potential);
    }
    for (std::size_t e = 0; e < emitted.count(); ++e)
        cells.forEachNear(emitted.position[e], [&](std::size_t p) {
            if (particles.id[p] < emitted.id[e]) sums[2].add(pairEnergyReference(field, emitted, e, particles, p));
        });
    const auto [kinetic, potential, pairs] = roundedOverRanks(*simulation.ranks, sums);
    simulation.cache->kinetic += kinetic;
    *simulation.cache->energy += kinetic + potential + pairs;
    simulation.cache->energyAtHeat += kinetic + potential + pairs;
}

void save(const Simulation& simulation, SavedState& saved) {
    const StepCache& cache = *simulation.cache;
    saved.time = simulation.time;
    saved.emitters = simulation.emitters;
    copy(simulation.particles.position, saved.position);
    copy(simulation.particles.velocity, saved.velocity);
    saved.nextId = simulation.particles.nextId;
    saved.forcesCurrent = cache.forcesCurrent;
    if (saved.forcesCurrent) copy(cache.forces, saved.forces);
    saved.energy = cache.energy;
    saved.kinetic = cache.kinetic;
    saved.groupEnergies = cache.groupEnergies;
    saved.work = cache.work;
    saved.workAtEnergy = cache.workAtEnergy;
    saved.allowance = energyAllowance(simulation);
    saved.steps = simulation.steps;
}

void restore(Simulation& simulation, const SavedState& saved) {
    Particles& particles = simulation.particles;
    truncate(particles, saved.position.size());
    simulation.time = saved.time;
    simulation.emitters = saved.emitters;
    particles.position = saved.position;
    particles.velocity = saved.velocity;
    particles.nextId = saved.nextId;
    StepCache& cache = *simulation.cache;
    cache.clearance.clear();
    cache.cachedNeighbors.clear();  // cleared, because a resumed run has none either
    cache.forcesCurrent = saved.forcesCurrent;
    if (saved.forcesCurrent) {
        cache.forces = saved.forces;
        cache.evaluator.renewList(particles);  // prepareDrift() expects a neighbor list as current as the forces
    }
    cache.energy = saved.energy;
    cache.kinetic = saved.kinetic;
    cache.groupEnergies = saved.groupEnergies;
    cache.work = saved.work;
    cache.workAtEnergy = saved.workAtEnergy;
    cache.stepLoads.clear();
    cache.meanAccelerations.clear();
    const StepStatistics spent = simulation.steps;
    simulation.steps = saved.steps;
    simulation.steps.forceEvaluations = spent.forceEvaluations;
    simulation.steps.matrices = spent.matrices;
    simulation.steps.products = spent.products;
    simulation.steps.rejected = spent.rejected;
}

std::optional<StepLimit> rejectionReason(const Simulation& simulation, const SavedState& saved) {
    if (movedTooFar(simulation, saved)) return StepLimit::displacement;
    if (!saved.energy) return std::nullopt;
    const double work = simulation.cache->workAtEnergy - saved.workAtEnergy;
    if (!(*simulation.cache->energy <= *saved.energy + work + allowanceFor(simulation, saved))) return StepLimit::audit;
    return std::nullopt;
}

}  // namespace engine
