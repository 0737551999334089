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
    cache.groupMotions = groupMotions(simulation);
}

std::vector<GroupMotion> groupMotions(const Simulation& simulation) {
    const FarGroups& groups = simulation.cache->evaluator.groups();
    const Particles& particles = simulation.particles;
    std::vector<GroupMotion> motions(groups.count());
    for (std::size_t p = 0; p < groups.groupOf.size(); ++p) {
        GroupMotion& motion = motions[groups.groupOf[p]];
        motion.mass += particles.mass[p];
        motion.momentum += particles.mass[p] * particles.velocity[p];
    }
    return motions;
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
