// Measures the distances of all particles that may touch an obstacle.
#include "engine/run/wall_depths.h"

#include <algorithm>

#include "engine/core/parallel.h"
#include "engine/obstacles/obstacle_surfaces.h"
#include "engine/stepping/drift.h"

namespace engine {
namespace {

/// Penetration of a particle into the obstacle that it is deepest in, in its radii; not positive where it touches none.
double depthOf(const Simulation& simulation, std::size_t p) {
    if (isClearOfObstacles(simulation, p)) return 0.0;
    const double radius = simulation.particles.radius[p];
    double depth = 0.0;
    forEachTouched(simulation.setup.obstacles, simulation.particles.position[p], simulation.time, radius,
                   [&](const Surface& surface) { depth = std::max(depth, 1.0 - surface.height / radius); });
    return depth;
}

}  // namespace

void recordWallDepths(Simulation& simulation) {
    if (simulation.setup.obstacles.shapes.empty()) return;
    const std::size_t count = simulation.particles.count();
    const double deepest =
        largestOfAll(*simulation.ranks, largestOver(count, [&](std::size_t p) { return depthOf(simulation, p); }));
    WallDepths& depths = simulation.wallDepths;
    depths.deepest = std::max(depths.deepest, deepest);
    if (deepest <= 1.0) return;
    const auto outside = sumOver<std::uint64_t>(
        count, [&](std::size_t p) -> std::uint64_t { return depthOf(simulation, p) > 1.0 ? 1 : 0; });
    depths.centersOutside = std::max(depths.centersOutside, sumOfAll(*simulation.ranks, outside));
}

}  // namespace engine
