// However many are born at once, nobody looks at everybody: cost and memory are linear in the particles.
#include "engine/stepping/population.h"

#include <algorithm>

#include "engine/core/parallel.h"
#include "engine/stepping/state_checks.h"
#include "engine/stepping/step_audit.h"

namespace engine {
namespace {

bool isBirthDue(const Simulation& simulation) {
    for (std::size_t e = 0; e < simulation.emitters.size(); ++e)
        if (nextBirth(simulation.setup.emitters[e], simulation.emitters[e]) <= simulation.time + kSameMoment)
            return true;
    return false;
}

/// The largest radius of the particles there are and of those that may be born, m.
double largestRadiusOf(const Simulation& simulation) {
    double largest = 0.0;
    for (const double radius : simulation.particles.radius) largest = std::max(largest, radius);
    for (const Emitter& emitter : simulation.setup.emitters)
        largest = std::max(largest, simulation.setup.materials[emitter.material].radius);
    return largest;
}

/// As far as any birth looks for room, and any newborn for what acts on it; 0 where neither is asked.
double lookedAround(const Simulation& simulation) {
    const double largestRadius = largestRadiusOf(simulation);
    double reach = simulation.energy ? reachOf(simulation.setup.materials) * 2.0 * largestRadius : 0.0;
    for (const Emitter& emitter : simulation.setup.emitters)
        reach = std::max(reach, birthReach(emitter, largestRadius));
    return reach;
}

}  // namespace

void giveBirth(Simulation& simulation) {
    if (!isBirthDue(simulation)) return;
    const std::size_t first = simulation.particles.count();
    const double reach = lookedAround(simulation);
    LinkedCells cells;
    if (reach > 0.0) cells = LinkedCells(reach, simulation.particles.position);
    for (std::size_t e = 0; e < simulation.setup.emitters.size(); ++e) {
        const Emitter& emitter = simulation.setup.emitters[e];
        const BirthContext context{simulation.time, simulation.setup.gravity, simulation.setup.seed, e};
        emit(emitter, simulation.emitters[e], context, simulation.setup.materials[emitter.material],
             simulation.particles, cells);
    }
    if (simulation.particles.count() == first) return;
    requireSound(simulation, 0.0);  // a nozzle may stand anywhere
    simulation.forcesCurrent = false;
    noteBirths(simulation, first, cells);
}

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
