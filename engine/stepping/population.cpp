// Emission and removal of particles. Every random number is a function of seed, emitter, schedule and emission, so the
// state of an emitter is a few counters, and a resumed run draws the same numbers as an uninterrupted one. Free space
// for a new particle is searched in linked cells, so that time and memory are linear in the number of particles even if
// many are emitted at once.
#include "engine/stepping/population.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/core/parallel.h"
#include "engine/core/random.h"
#include "engine/neighbors/linked_cells.h"
#include "engine/state/state_checks.h"
#include "engine/stepping/free_groups.h"
#include "engine/stepping/step_audit.h"
#include "engine/stepping/step_cache.h"

namespace engine {
namespace {

/// How many times per interval between emissions an emission that has found no room is tried again. Chosen: each try
/// ends a time step, so few are wanted.
constexpr double kTriesPerInterval = 4.0;

/// The purposes of an emitter's random numbers; each purpose has a stream of random numbers of its own.
enum class Purpose : std::uint64_t { site = 0, jitterFirst = 1, jitterSecond = 2 };

/// The index of an emitter in the setup, of one of its schedules, and of an emission of that schedule.
struct Emission {
    std::uint64_t emitter = 0;
    std::uint64_t schedule = 0;
    std::uint64_t number = 0;
};

std::uint64_t drawBits(const Setup& setup, const Emission& emission, Purpose purpose) {
    const std::uint64_t stream =
        (emission.emitter << 40) ^ (emission.schedule << 2) ^ static_cast<std::uint64_t>(purpose);
    return randomBits(setup.seed, stream, emission.number);
}

Vec3 siteOf(const Setup& setup, const Emission& emission) {
    const Emitter& emitter = setup.emitters[emission.emitter];
    if (emitter.pick == Pick::all) return emitter.sites[emission.schedule];
    return emitter.sites[drawBits(setup, emission, Purpose::site) % emitter.sites.size()];
}

/// Random displacement across the emitter's velocity, in units of the emitter's jitter.
Vec3 jitterOf(const Setup& setup, const Emission& emission) {
    const Emitter& emitter = setup.emitters[emission.emitter];
    if (emitter.jitter == 0.0) return Vec3::Zero();
    const PlaneAxes plane = axesAcross(emitter.velocity);
    return symmetricUnit(drawBits(setup, emission, Purpose::jitterFirst)) * plane.first +
           symmetricUnit(drawBits(setup, emission, Purpose::jitterSecond)) * plane.second;
}

bool hasRoom(const Particles& particles, const LinkedCells& cells, const NewParticle& added, double clearance) {
    if (clearance == 0.0) return true;
    bool hasRoom = true;
    cells.forEachNear(added.position, [&](std::size_t p) {
        const double least = clearance * (particles.radius[p] + added.radius);
        if (squaredLength(particles.position[p] - added.position) < least * least) hasRoom = false;
    });
    return hasRoom;
}

/// The particle of an emission at a time (s), which was due `late` seconds before. Since then it has flown freely under
/// gravity.
NewParticle particleOf(const Setup& setup, const Emission& emission, double time, double late) {
    const Emitter& emitter = setup.emitters[emission.emitter];
    const Material& material = setup.materials[emitter.material];
    NewParticle particle;
    particle.position = siteOf(setup, emission) + emitter.jitter * material.radius * jitterOf(setup, emission);
    particle.position += late * emitter.velocity + 0.5 * late * late * setup.gravity;
    particle.velocity = emitter.velocity + late * setup.gravity;
    particle.radius = material.radius;
    particle.mass = material.mass;
    particle.birthTime = time - late;
    particle.material = emitter.material;
    return particle;
}

/// The largest radius of the present particles and of the particles that emitters may add, m.
double largestRadiusOf(const Simulation& simulation) {
    double largest = 0.0;
    for (const double radius : simulation.particles.radius) largest = std::max(largest, radius);
    for (const Emitter& emitter : simulation.setup.emitters)
        largest = std::max(largest, simulation.setup.materials[emitter.material].radius);
    return largest;
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

/// Emits the particles that the emitter of this index has due, where there is room, and adds them to the cells.
void emitFrom(std::size_t index, Simulation& simulation, LinkedCells& cells) {
    const Setup& setup = simulation.setup;
    const Emitter& emitter = setup.emitters[index];
    EmitterState& state = simulation.emitters[index];
    for (std::size_t s = 0; s < state.schedules.size(); ++s) {
        Schedule& schedule = state.schedules[s];
        while (schedule.due <= simulation.time + kSameMoment && schedule.due < emitter.until - kSameMoment &&
               state.births < emitter.limit) {
            const double late = std::max(0.0, simulation.time - schedule.due);
            const NewParticle particle = particleOf(setup, {index, s, schedule.births}, simulation.time, late);
            if (!hasRoom(simulation.particles, cells, particle, emitter.clearance)) {
                if (!schedule.delayed) ++state.refusals;
                schedule.delayed = true;
                schedule.due += emitter.interval / kTriesPerInterval;
                continue;
            }
            append(simulation.particles, particle);
            cells.add(particle.position);
            // A delay shifts the whole schedule; otherwise the delayed particles would come in a burst.
            ++schedule.births;
            if (schedule.delayed)
                schedule.origin = schedule.due - static_cast<double>(schedule.births - 1) * emitter.interval;
            schedule.due = dueTime(emitter, schedule);
            schedule.delayed = false;
            ++state.births;
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
    const std::size_t first = simulation.particles.count();
    const double width = cellWidthFor(simulation);
    LinkedCells cells;
    if (width > 0.0) cells = LinkedCells(width, simulation.particles.position);
    for (std::size_t e = 0; e < simulation.setup.emitters.size(); ++e) emitFrom(e, simulation, cells);
    if (simulation.particles.count() == first) return;
    requireValid(simulation, 0.0);  // an emitter may stand outside the world's limit
    simulation.cache->forcesCurrent = false;
    addEnergyOfEmitted(simulation, first, cells);
}

void removeOutOfBounds(Simulation& simulation) {
    if (!simulation.setup.world) return;
    const BoundingBox& world = *simulation.setup.world;
    Particles& particles = simulation.particles;
    const auto stays = [&](std::size_t p) { return world.contains(particles.position[p]); };
    if (largestOver(particles.count(), [&](std::size_t p) { return stays(p) ? 0.0 : 1.0; }) == 0.0) return;
    const std::size_t countBefore = particles.count();
    keepWhere(particles, stays);
    simulation.removedCount += countBefore - particles.count();
    simulation.largestCountBeforeRemoval = std::max<std::uint64_t>(simulation.largestCountBeforeRemoval, countBefore);
    simulation.cache->invalidate();
    renewGroups(simulation);
}

}  // namespace engine
