// Looking is cheap and happens every interval; closing the ranks is for the few in which somebody leaves.
#include "engine/deaths.h"

#include <algorithm>

#include "engine/parallel.h"

namespace engine {

void removeLeavers(Simulation& simulation) {
    if (!simulation.setup.world) return;
    const Bounds& world = *simulation.setup.world;
    Particles& particles = simulation.particles;
    const auto stays = [&](std::size_t p) { return contains(world, particles.position[p]); };
    if (largestOver(particles.count(), [&](std::size_t p) { return stays(p) ? 0.0 : 1.0; }) == 0.0) return;
    const std::size_t before = particles.count();
    keepWhere(particles, stays);
    simulation.deaths += before - particles.count();
    simulation.mostBeforeDeaths = std::max<std::uint64_t>(simulation.mostBeforeDeaths, before);
    // All of it is by index.
    simulation.forcesCurrent = false;
    simulation.clearance.clear();
    simulation.evaluator.forgetList();
    simulation.energy.reset();
}

}  // namespace engine
