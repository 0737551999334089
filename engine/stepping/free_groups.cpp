// Groups in free fall: how far apart they are, how they move, and whether they stay apart.
#include "engine/stepping/free_groups.h"

#include <algorithm>

#include "engine/core/parallel.h"
#include "engine/stepping/drift.h"

namespace engine {
namespace {

/// Least gap between groups, in the distances at which particles act on or touch each other. Chosen: so wide that the
/// drops of a splash and their pool are one group.
constexpr double kFar = 32.0;

/// Distance (m) beyond which no two particles act on or touch each other.
double interactionRange(const Simulation& simulation) {
    const Particles& particles = simulation.particles;
    const double largest = largestOver(particles.count(), [&](std::size_t p) { return particles.radius[p]; });
    return std::max(2.0 * largest, termsFor(simulation.cache->evaluator.forceField(), particles).cutoff);
}

}  // namespace

void renewGroups(Simulation& simulation) {
    StepCache& cache = *simulation.cache;
    cache.evaluator.setGroups(findFarGroups(simulation.particles.position, kFar * interactionRange(simulation)));
    cache.groupEnergies = groupEnergies(simulation);
}

std::vector<GroupEnergy> groupEnergies(const Simulation& simulation) {
    const FarGroups& groups = simulation.cache->evaluator.groups();
    const Particles& particles = simulation.particles;
    std::vector<GroupEnergy> energies(groups.count());
    std::vector<double> mass(groups.count());
    std::vector<Vec3> momentum(groups.count(), Vec3::Zero());
    for (std::size_t p = 0; p < groups.groupOf.size(); ++p) {
        const std::uint32_t group = groups.groupOf[p];
        mass[group] += particles.mass[p];
        momentum[group] += particles.mass[p] * particles.velocity[p];
        energies[group].potential -= particles.mass[p] * dot(simulation.setup.gravity, particles.position[p]);
    }
    for (std::size_t group = 0; group < groups.count(); ++group)
        energies[group].kinetic = 0.5 * squaredLength(momentum[group]) / mass[group];
    return energies;
}

std::vector<bool> groupsInFreeFall(const Simulation& simulation, const std::vector<Vec3>& before) {
    const FarGroups& groups = simulation.cache->evaluator.groups();
    std::vector<bool> areFree(groups.count(), true);
    for (std::size_t p = 0; p < groups.groupOf.size(); ++p)
        if (areFree[groups.groupOf[p]] && !hadFreePath(simulation, p, before[p])) areFree[groups.groupOf[p]] = false;
    return areFree;
}

bool haveStayedApart(const Simulation& simulation, const std::vector<Vec3>& before) {
    const FarGroups& groups = simulation.cache->evaluator.groups();
    std::vector<Vec3> motions;
    for (const std::uint32_t leader : groups.leaders)
        motions.push_back(simulation.particles.position[leader] - before[leader]);
    // The margin is the range itself and two radii, which are at most a range, for each of the two groups: a particle
    // that stayed within its radius of its old place is within two of where its group's motion has carried it.
    return stayApart(groups, before, motions, 3.0 * interactionRange(simulation));
}

}  // namespace engine
