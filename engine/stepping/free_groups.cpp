// Groups in free fall: how far apart they are, how they move, and whether they stay apart.
#include "engine/stepping/free_groups.h"

#include <algorithm>

#include "engine/core/parallel.h"
#include "engine/ranks/exact_sums.h"
#include "engine/stepping/drift.h"

namespace engine {
namespace {

/// Least gap between groups, in the distances at which particles act on or touch each other. Chosen: so wide that the
/// drops of a splash and their pool are one group.
constexpr double kFar = 32.0;

/// Distance (m) beyond which no two particles act on or touch each other.
double interactionRange(const Simulation& simulation) {
    const Particles& particles = simulation.particles;
    const ForceTerms terms = termsFor(simulation.cache->evaluator.forceField(), particles, *simulation.ranks);
    return std::max(2.0 * terms.largestRadius, terms.cutoff);
}

}  // namespace

void renewGroups(Simulation& simulation) {
    StepCache& cache = *simulation.cache;
    const Particles& particles = simulation.particles;
    cache.evaluator.setGroups(
        findFarGroups(*simulation.ranks, particles.position, particles.id, kFar * interactionRange(simulation)));
    cache.groupEnergies = groupEnergies(simulation);
}

std::vector<GroupEnergy> groupEnergies(const Simulation& simulation) {
    const FarGroups& groups = simulation.cache->evaluator.groups();
    const Particles& particles = simulation.particles;
    using Sums = std::array<ExactSum, 5>;  // mass, momentum along x, y and z, potential energy
    std::vector<Sums> sums(groups.count());
    for (std::size_t p = 0; p < groups.groupOf.size(); ++p) {
        Sums& group = sums[groups.groupOf[p]];
        const double mass = particles.mass[p];
        group[0].add(mass);
        for (int axis = 0; axis < 3; ++axis)
            group[static_cast<std::size_t>(axis) + 1].add(mass * particles.velocity[p][axis]);
        group[4].add(-mass * dot(simulation.setup.gravity, particles.position[p]));
    }
    std::vector<GroupEnergy> energies;
    for (Sums& group : sums) {
        const auto [mass, x, y, z, potential] = roundedOverRanks(*simulation.ranks, group);
        energies.push_back({0.5 * squaredLength(Vec3(x, y, z)) / mass, potential});
    }
    return energies;
}

std::vector<bool> groupsInFreeFall(const Simulation& simulation, const std::vector<Vec3>& before) {
    const FarGroups& groups = simulation.cache->evaluator.groups();
    std::vector<bool> areFree(groups.count(), true);
    for (std::size_t p = 0; p < groups.groupOf.size(); ++p)
        if (areFree[groups.groupOf[p]] && !hadFreePath(simulation, p, before[p])) areFree[groups.groupOf[p]] = false;
    if (!simulation.ranks->areMany()) return areFree;
    std::vector<double> numbers;
    for (const bool isFree : areFree) numbers.push_back(isFree ? 0.0 : 1.0);
    simulation.ranks->maximize(numbers);
    for (std::size_t group = 0; group < numbers.size(); ++group) areFree[group] = numbers[group] == 0.0;
    return areFree;
}

std::vector<Vec3> motionsOfGroups(const Simulation& simulation, const std::vector<Vec3>& before) {
    return ofLeaders(*simulation.ranks, simulation.cache->evaluator.groups(), [&](std::uint32_t leader) -> Vec3 {
        return simulation.particles.position[leader] - before[leader];
    });
}

bool haveStayedApart(const Simulation& simulation, const std::vector<Vec3>& before) {
    const FarGroups& groups = simulation.cache->evaluator.groups();
    // The margin is the range itself and two radii, which are at most a range, for each of the two groups: a particle
    // that stayed within its radius of its old place is within two of where its group's motion has carried it.
    return stayApart(*simulation.ranks, groups, before, motionsOfGroups(simulation, before),
                     3.0 * interactionRange(simulation));
}

}  // namespace engine
