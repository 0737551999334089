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

/// What can be seen of a particle.
struct Appearance {
    Vec3 position;
    Vec3 velocity;
    double radius = 0.0;
    double mass = 0.0;
    double birthTime = 0.0;
    std::uint32_t material = 0;
    std::uint32_t id = 0;
};

Appearance appearanceOf(const Simulation& simulation, std::size_t p) {
    const Particles& particles = simulation.particles;
    return {particles.position[p],  particles.velocity[p], particles.radius[p], particles.mass[p],
            particles.birthTime[p], particles.material[p], particles.id[p]};
}

/// A particle with all that later steps depend on, on its way to another rank.
struct Traveler : Appearance {
    Vec3 force = Vec3::Zero();
    Vec3 meanAcceleration = Vec3::Zero();
    Vec3 builtAt = Vec3::Zero();
    bool hasForce = false;
    bool hasMeanAcceleration = false;
    bool isListed = false;  ///< whether it was there when the neighbor list was built
};

Traveler travelerOf(const Simulation& simulation, std::size_t p) {
    const StepCache& cache = *simulation.cache;
    Traveler traveler{appearanceOf(simulation, p)};
    const auto take = [&](const std::vector<Vec3>& from, Vec3& to, bool& has) {
        has = p < from.size();
        if (has) to = from[p];
    };
    take(cache.forces, traveler.force, traveler.hasForce);
    take(cache.meanAccelerations, traveler.meanAcceleration, traveler.hasMeanAcceleration);
    take(cache.evaluator.list().builtAt, traveler.builtAt, traveler.isListed);
    return traveler;
}

/// Sends what recordOf(simulation, index) returns of each particle to the rank that rankOf(position) names.
template <class Record, class RankOf>
std::vector<Record> sendParticles(const Ranks& ranks, const Simulation& simulation,
                                  Record (*recordOf)(const Simulation&, std::size_t), const RankOf& rankOf) {
    std::vector<std::vector<Record>> toRanks(static_cast<std::size_t>(ranks.count()));
    for (std::size_t p = 0; p < simulation.particles.count(); ++p)
        toRanks[static_cast<std::size_t>(rankOf(simulation.particles.position[p]))].push_back(recordOf(simulation, p));
    return exchangeItems(ranks, toRanks);
}

/// Calls visit(record) for all records in ascending order of their ids.
template <class Record, class Visit>
void inOrder(const std::vector<Record>& records, const Visit& visit) {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> order;  // ids and indices, which are moved faster than records
    order.reserve(records.size());
    for (std::uint32_t k = 0; k < records.size(); ++k) order.emplace_back(records[k].id, k);
    std::ranges::sort(order);
    for (const auto& [id, k] : order) visit(records[k]);
}

void clear(Particles& particles, std::size_t room) {
    forEachArray(particles, [&](auto& array) {
        array.clear();
        array.reserve(room);
    });
}

void add(const Appearance& particle, Particles& particles) {
    particles.position.push_back(particle.position);
    particles.velocity.push_back(particle.velocity);
    particles.radius.push_back(particle.radius);
    particles.mass.push_back(particle.mass);
    particles.birthTime.push_back(particle.birthTime);
    particles.material.push_back(particle.material);
    particles.id.push_back(particle.id);
}

/// Replaces the particles of a simulation, with what belongs to them; returns where they were when the neighbor list
/// was built.
std::vector<Vec3> replaceParticles(Simulation& simulation, const std::vector<Traveler>& travelers) {
    StepCache& cache = *simulation.cache;
    clear(simulation.particles, travelers.size());
    cache.forces.clear();
    cache.meanAccelerations.clear();
    cache.clearance.clear();
    cache.cachedNeighbors.clear();
    std::vector<Vec3> builtAt;
    inOrder(travelers, [&](const Traveler& traveler) {
        add(traveler, simulation.particles);
        // The newest particles may have none of these.
        if (traveler.hasForce) cache.forces.push_back(traveler.force);
        if (traveler.hasMeanAcceleration) cache.meanAccelerations.push_back(traveler.meanAcceleration);
        if (traveler.isListed) builtAt.push_back(traveler.builtAt);
    });
    return builtAt;
}

/// Continues with other particles.
/// @param cutoff  with the skin, both in meters, of the neighbor list
void settle(Simulation& simulation, const std::vector<Traveler>& travelers, double cutoff, double skin) {
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

/// A twin with the particles of all ranks on rank 0, and none on the others.
TwinRun gatherTwin(const Ranks& ranks, const TwinRun& twin) {
    std::vector<std::vector<TwinParticle>> toRanks(static_cast<std::size_t>(ranks.count()));
    for (std::size_t t = 0; t < twin.id.size(); ++t) toRanks[0].push_back({twin.position[t], twin.id[t]});
    std::vector<TwinParticle> particles = exchangeItems(ranks, toRanks);
    std::ranges::sort(particles, {}, &TwinParticle::id);
    TwinRun whole = twin;
    whole.position.clear();
    whole.id.clear();
    for (const TwinParticle& particle : particles) {
        whole.position.push_back(particle.position);
        whole.id.push_back(particle.id);
    }
    return whole;
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

int rankZero(const Vec3& /*position*/) {
    return 0;
}

}  // namespace

void redistribute(Simulation& simulation) {
    const Ranks& ranks = *simulation.ranks;
    const auto ownerOf = [&](const Vec3& position) { return ranks.ownerOf(position); };
    const auto travelers = sendParticles(ranks, simulation, travelerOf, ownerOf);
    const NeighborList& list = simulation.cache->evaluator.list();
    settle(simulation, travelers, list.cutoff, list.skin);
}

void gather(const Simulation& simulation, Simulation& whole) {
    const Ranks& ranks = *simulation.ranks;
    const auto appearances = sendParticles(ranks, simulation, appearanceOf, rankZero);
    const std::uint64_t held = sumOfAll(ranks, simulation.steps.held);
    if (ranks.own() != 0) return;
    copyCommon(simulation, whole);
    whole.steps.held = held;
    whole.cache->invalidate();
    clear(whole.particles, appearances.size());
    inOrder(appearances, [&](const Appearance& particle) { add(particle, whole.particles); });
}

std::vector<std::uint8_t> gatherCheckpoint(const Simulation& simulation) {
    const Ranks& ranks = *simulation.ranks;
    const auto travelers = sendParticles(ranks, simulation, travelerOf, rankZero);
    const std::uint64_t held = sumOfAll(ranks, simulation.steps.held);
    TwinRun twin = gatherTwin(ranks, simulation.automatic.twin);
    if (ranks.own() != 0) return {};
    Simulation whole;
    copyCommon(simulation, whole);
    whole.setup.materials = simulation.setup.materials;
    whole.automatic.twin = std::move(twin);
    whole.steps.held = held;
    const std::vector<Vec3> builtAt = replaceParticles(whole, travelers);
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
    const auto ownerOf = [&](const Vec3& position) { return ranks.ownerOf(position); };
    const auto travelers = sendParticles(ranks, simulation, travelerOf, ownerOf);
    simulation.ranks = &ranks;
    const Setup& setup = simulation.setup;
    simulation.cache->evaluator = ForceEvaluator(forceFieldOf(setup), setup.forces, setup.precision, ranks);
    settle(simulation, travelers, reach[0], reach[1]);
}

}  // namespace engine
