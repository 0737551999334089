// Emission and removal of particles. Free space for a new particle is searched in linked cells, so that time and memory
// are linear in the number of particles even if many are emitted at once.
#include "engine/stepping/population.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/core/parallel.h"
#include "engine/neighbors/linked_cells.h"
#include "engine/state/emission.h"
#include "engine/state/state_checks.h"
#include "engine/stepping/free_groups.h"
#include "engine/stepping/step_audit.h"
#include "engine/stepping/step_cache.h"

namespace engine {
namespace {

/// How often the site of an emission is drawn anew where the one before has no room. Chosen: of sites of which a
/// quarter are free, nine in ten tries find one.
constexpr std::uint64_t kDrawsOfSite = 8;

bool hasRoom(const Particles& particles, const LinkedCells& cells, const NewParticle& added, double clearance) {
    if (clearance == 0.0) return true;
    bool hasRoom = true;
    cells.forEachNear(added.position, [&](std::size_t p) {
        const double least = clearance * (particles.radius[p] + added.radius);
        if (squaredLength(particles.position[p] - added.position) < least * least) hasRoom = false;
    });
    return hasRoom;
}

/// The largest radius of the present particles and of the particles that emitters may add, m.
double largestRadiusOf(const Simulation& simulation) {
    double largest = 0.0;
    for (const double radius : simulation.particles.radius) largest = std::max(largest, radius);
    for (const Emitter& emitter : simulation.setup.emitters)
        largest = std::max(largest, simulation.setup.materials[emitter.material].radius);
    return largestOfAll(*simulation.ranks, largest);
}

/// Cell width (m) with which neighboring cells contain all particles that may block an emission and, where the energy
/// is recorded, all particles that act on a new one. 0 where neither is needed.
double cellWidthFor(const Simulation& simulation) {
    const double largestRadius = largestRadiusOf(simulation);
    double width = simulation.cache->energy ? cutoffRatio(simulation.setup.materials) * 2.0 * largestRadius : 0.0;
    for (const Emitter& emitter : simulation.setup.emitters)
        width = std::max(width, emitter.clearance * 2.0 * largestRadius);
    return width;
}

/// Draws the particles of an emission that was due `late` seconds before. Returns whether there is room for them.
bool findRoom(const Simulation& simulation, const LinkedCells& cells, Emission emission, double late,
              std::vector<NewParticle>& particles) {
    const Emitter& emitter = simulation.setup.emitters[emission.emitter];
    const std::uint64_t draws = emitter.pick == Pick::random ? kDrawsOfSite : 1;
    for (; emission.attempt < draws; ++emission.attempt) {
        drawEmission(simulation.setup, emission, simulation.time, late, particles);
        const auto fits = [&](const NewParticle& particle) {
            return hasRoom(simulation.particles, cells, particle, emitter.clearance);
        };
        const bool areFitting = std::all_of(particles.begin(), particles.end(), fits);
        if (emitter.clearance == 0.0 || holdsOnAll(*simulation.ranks, areFitting)) return true;
    }
    return false;
}

/// Gives a new particle the next id, and adds it to the particles of its owner and to the cells there.
void add(const NewParticle& particle, Simulation& simulation, LinkedCells& cells) {
    const Ranks& ranks = *simulation.ranks;
    if (ranks.ownerOf(particle.position) != ranks.own()) {
        ++simulation.particles.nextId;
        return;
    }
    append(simulation.particles, particle);
    cells.add(particle.position);
}

/// Emits the particles that the emitter of this index has due, where there is room.
/// @param emitted  receives the new particles of all ranks
void emitFrom(std::size_t index, Simulation& simulation, LinkedCells& cells, Particles& emitted) {
    const Emitter& emitter = simulation.setup.emitters[index];
    EmitterState& state = simulation.emitters[index];
    std::vector<NewParticle> particles;
    for (std::size_t s = 0; s < state.schedules.size(); ++s) {
        Schedule& schedule = state.schedules[s];
        while (takesPlace(emitter, schedule.due, simulation.time) && schedule.due < emitter.until - kSameMoment &&
               hasLeft(emitter, state)) {
            const double late = std::max(0.0, simulation.time - schedule.due);
            if (!findRoom(simulation, cells, {index, s, schedule.births}, late, particles)) {
                schedule.delayed = true;
                schedule.due += retryDelay(emitter);
                continue;
            }
            for (const NewParticle& particle : particles) {
                add(particle, simulation, cells);
                append(emitted, particle);
            }
            // A delay shifts the whole schedule; otherwise the delayed particles would come in a burst.
            ++schedule.births;
            if (schedule.delayed)
                schedule.origin = schedule.due - static_cast<double>(schedule.births - 1) * emitter.interval;
            schedule.due = dueTime(emitter, schedule);
            schedule.delayed = false;
            state.births += particles.size();
        }
    }
}

}  // namespace

double nextEmission(const Simulation& simulation) {
    double next = std::numeric_limits<double>::infinity();
    for (std::size_t e = 0; e < simulation.emitters.size(); ++e)
        next = std::min(next, nextEmission(simulation.setup.emitters[e], simulation.emitters[e]));
    return next;
}

void emitDue(Simulation& simulation) {
    if (nextEmission(simulation) > simulation.time + kSameMoment) return;
    Particles emitted;
    emitted.nextId = simulation.particles.nextId;
    const double width = cellWidthFor(simulation);
    LinkedCells cells;
    if (width > 0.0) cells = LinkedCells(width, simulation.particles.position);
    for (std::size_t e = 0; e < simulation.setup.emitters.size(); ++e) emitFrom(e, simulation, cells, emitted);
    if (emitted.count() == 0) return;
    requireValid(simulation, 0.0);  // an emitter may stand outside the world's limit
    simulation.cache->forcesCurrent = false;
    addEnergyOfEmitted(simulation, emitted, cells);
}

void removeOutOfBounds(Simulation& simulation) {
    if (!simulation.setup.world) return;
    const BoundingBox& world = *simulation.setup.world;
    Particles& particles = simulation.particles;
    const auto stays = [&](std::size_t p) { return world.contains(particles.position[p]); };
    const bool doAllStay = largestOver(particles.count(), [&](std::size_t p) { return stays(p) ? 0.0 : 1.0; }) == 0.0;
    if (holdsOnAll(*simulation.ranks, doAllStay)) return;
    const std::uint64_t countBefore = countOfAll(simulation);
    keepWhere(particles, stays);
    simulation.removedCount += countBefore - countOfAll(simulation);
    simulation.largestCountBeforeRemoval = std::max(simulation.largestCountBeforeRemoval, countBefore);
    simulation.cache->invalidate();
    renewGroups(simulation);
}

}  // namespace engine
