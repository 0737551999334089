// Packs particles with all that belongs to them, sends them, and rebuilds the neighbor list for where it was built.
#include "engine/run/redistribution.h"

#include <algorithm>
#include <cstring>

#include "engine/ranks/exchange.h"
#include "engine/run/checkpoint.h"
#include "engine/stepping/free_groups.h"
#include "engine/stepping/step_cache.h"

namespace engine {
namespace {

/// A particle on its way to another rank.
struct Traveler {
    Vec3 position;
    Vec3 velocity;
    Vec3 force = Vec3::Zero();
    Vec3 meanAcceleration = Vec3::Zero();
    Vec3 builtAt = Vec3::Zero();
    double radius = 0.0;
    double mass = 0.0;
    double birthTime = 0.0;
    std::uint32_t material = 0;
    std::uint32_t id = 0;
    bool hasForce = false;
    bool hasMeanAcceleration = false;
    bool isListed = false;  ///< whether it was there when the neighbor list was built
};

Traveler travelerOf(const Simulation& simulation, std::size_t p) {
    const Particles& particles = simulation.particles;
    const StepCache& cache = *simulation.cache;
    const std::vector<Vec3>& builtAt = cache.evaluator.list().builtAt;
    Traveler traveler;
    traveler.position = particles.position[p];
    traveler.velocity = particles.velocity[p];
    traveler.radius = particles.radius[p];
    traveler.mass = particles.mass[p];
    traveler.birthTime = particles.birthTime[p];
    traveler.material = particles.material[p];
    traveler.id = particles.id[p];
    const auto take = [&](const std::vector<Vec3>& from, Vec3& to, bool& has) {
        has = p < from.size();
        if (has) to = from[p];
    };
    take(cache.forces, traveler.force, traveler.hasForce);
    take(cache.meanAccelerations, traveler.meanAcceleration, traveler.hasMeanAcceleration);
    take(builtAt, traveler.builtAt, traveler.isListed);
    return traveler;
}

/// Replaces the particles of a simulation, with what belongs to them; returns where they were when the neighbor list
/// was built.
std::vector<Vec3> replaceParticles(Simulation& simulation, std::vector<Traveler>& travelers) {
    std::ranges::sort(travelers, {}, &Traveler::id);
    Particles& particles = simulation.particles;
    StepCache& cache = *simulation.cache;
    forEachArray(particles, [](auto& array) { array.clear(); });
    cache.forces.clear();
    cache.meanAccelerations.clear();
    cache.clearance.clear();
    cache.cachedNeighbors.clear();
    std::vector<Vec3> builtAt;
    for (const Traveler& traveler : travelers) {
        particles.position.push_back(traveler.position);
        particles.velocity.push_back(traveler.velocity);
        particles.radius.push_back(traveler.radius);
        particles.mass.push_back(traveler.mass);
        particles.birthTime.push_back(traveler.birthTime);
        particles.material.push_back(traveler.material);
        particles.id.push_back(traveler.id);
        // The newest particles may have none of these.
        if (traveler.hasForce) cache.forces.push_back(traveler.force);
        if (traveler.hasMeanAcceleration) cache.meanAccelerations.push_back(traveler.meanAcceleration);
        if (traveler.isListed) builtAt.push_back(traveler.builtAt);
    }
    return builtAt;
}

/// Sends the particles of a simulation to the ranks that rankOf(position) names.
template <class RankOf>
std::vector<Traveler> sendParticles(const Ranks& ranks, const Simulation& simulation, const RankOf& rankOf) {
    std::vector<std::vector<Traveler>> toRanks(static_cast<std::size_t>(ranks.count()));
    for (std::size_t p = 0; p < simulation.particles.count(); ++p)
        toRanks[static_cast<std::size_t>(rankOf(simulation.particles.position[p]))].push_back(
            travelerOf(simulation, p));
    return exchangeItems(ranks, toRanks);
}

/// Continues with other particles.
/// @param cutoff  with the skin, both in meters, of the neighbor list
void settle(Simulation& simulation, std::vector<Traveler>& travelers, double cutoff, double skin) {
    const std::vector<Vec3> builtAt = replaceParticles(simulation, travelers);
    renewGroups(simulation);
    ForceEvaluator& evaluator = simulation.cache->evaluator;
    evaluator.restoreList(simulation.particles, builtAt, cutoff, skin);
    evaluator.fetchGhosts(simulation.particles);
}

/// A particle at the end of a twin.
struct TwinParticle {
    Vec3 position;
    std::uint32_t id = 0;
};

/// Brings the particles at the end of a twin together on rank 0.
void gatherTwin(const Ranks& ranks, const TwinRun& twin, TwinRun& whole) {
    std::vector<std::vector<TwinParticle>> toRanks(static_cast<std::size_t>(ranks.count()));
    for (std::size_t t = 0; t < twin.id.size(); ++t) toRanks[0].push_back({twin.position[t], twin.id[t]});
    std::vector<TwinParticle> particles = exchangeItems(ranks, toRanks);
    std::ranges::sort(particles, {}, &TwinParticle::id);
    whole.position.clear();
    whole.id.clear();
    for (const TwinParticle& particle : particles) {
        whole.position.push_back(particle.position);
        whole.id.push_back(particle.id);
    }
}

/// What rank 0 gives, on all ranks.
std::vector<std::uint8_t> ofRankZero(const Ranks& ranks, const std::vector<std::uint8_t>& bytes) {
    std::vector<double> numbers;
    if (ranks.own() == 0) numbers.assign(bytes.begin(), bytes.end());
    numbers = ranks.gatherAll(numbers);
    return {numbers.begin(), numbers.end()};
}

/// Makes `whole` what it is without particles.
void copyCommon(const Simulation& simulation, Simulation& whole) {
    whole.emitters = simulation.emitters;
    whole.removedCount = simulation.removedCount;
    whole.largestCountBeforeRemoval = simulation.largestCountBeforeRemoval;
    whole.time = simulation.time;
    whole.stepper = simulation.stepper;
    whole.restriction = simulation.restriction;
    whole.automatic = simulation.automatic;
    whole.steps = simulation.steps;
    whole.wallDepths = simulation.wallDepths;
    whole.particles.nextId = simulation.particles.nextId;
}

/// gather(), which returns the positions for which the neighbor list was built.
std::vector<Vec3> gatherAll(const Simulation& simulation, Simulation& whole) {
    const Ranks& ranks = *simulation.ranks;
    std::vector<Traveler> travelers = sendParticles(ranks, simulation, [](const Vec3&) { return 0; });
    const std::uint64_t held = sumOfAll(ranks, simulation.steps.held);
    if (ranks.own() != 0) return {};
    copyCommon(simulation, whole);
    whole.steps.held = held;
    whole.cache->invalidate();
    return replaceParticles(whole, travelers);
}

}  // namespace

void redistribute(Simulation& simulation) {
    const Ranks& ranks = *simulation.ranks;
    auto travelers = sendParticles(ranks, simulation, [&](const Vec3& position) { return ranks.ownerOf(position); });
    const NeighborList& list = simulation.cache->evaluator.list();
    settle(simulation, travelers, list.cutoff, list.skin);
}

void gather(const Simulation& simulation, Simulation& whole) {
    gatherAll(simulation, whole);
}

std::vector<std::uint8_t> gatherCheckpoint(const Simulation& simulation) {
    Simulation whole;
    whole.setup.materials = simulation.setup.materials;
    const std::vector<Vec3> builtAt = gatherAll(simulation, whole);
    gatherTwin(*simulation.ranks, simulation.automatic.twin, whole.automatic.twin);
    if (simulation.ranks->own() != 0) return {};
    const StepCache& cache = *simulation.cache;
    whole.cache->forcesCurrent = cache.forcesCurrent;
    whole.cache->energy = cache.energy;
    whole.cache->kinetic = cache.kinetic;
    whole.cache->lastStep = cache.lastStep;
    const NeighborList& list = cache.evaluator.list();
    return encodeCheckpoint(whole, {builtAt, list.cutoff, list.skin});
}

void divide(Simulation& simulation, const Ranks& ranks) {
    const std::vector<std::uint8_t> common = ofRankZero(ranks, encodeCommon(simulation));
    if (ranks.own() != 0) {
        forEachArray(simulation.particles, [](auto& array) { array.clear(); });
        simulation.cache->invalidate();
        decodeCommon(common, simulation);
        simulation.steps.held = 0;
    }
    const NeighborList& list = simulation.cache->evaluator.list();
    std::array reach = {list.cutoff, list.skin};
    if (ranks.own() != 0) reach = {0.0, 0.0};
    ranks.maximize(reach);
    auto travelers = sendParticles(ranks, simulation, [&](const Vec3& position) { return ranks.ownerOf(position); });
    simulation.ranks = &ranks;
    const Setup& setup = simulation.setup;
    simulation.cache->evaluator = ForceEvaluator(forceFieldOf(setup), setup.forces, setup.precision, ranks);
    settle(simulation, travelers, reach[0], reach[1]);
}

}  // namespace engine
