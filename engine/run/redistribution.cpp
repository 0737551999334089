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

/// A particle as files have it.
struct ParticleRecord {
    NewParticle particle;
    std::uint32_t id = 0;
};

ParticleRecord recordOf(const Simulation& simulation, std::size_t p) {
    const Particles& particles = simulation.particles;
    return {
        {particles.position[p], particles.velocity[p], particles.radius[p], particles.mass[p], particles.birthTime[p],
         particles.material[p], particles.enthalpy.empty() ? NewParticle{}.enthalpy : particles.enthalpy[p]},
        particles.id[p]};
}

/// A particle with all that later steps depend on, for the migration to another rank.
struct MigrationRecord : ParticleRecord {
    Vec3 force = Vec3::Zero();
    Vec3 meanAcceleration = Vec3::Zero();
    Vec3 builtAt = Vec3::Zero();
    bool hasForce = false;
    bool hasMeanAcceleration = false;
    bool isListed = false;  ///< whether it was there when the neighbor list was built
};

MigrationRecord migrationRecordOf(const Simulation& simulation, std::size_t p) {
    const StepCache& cache = *simulation.cache;
    MigrationRecord record{recordOf(simulation, p)};
    const auto take = [&](const std::vector<Vec3>& from, Vec3& to, bool& has) {
        has = p < from.size();
        if (has) to = from[p];
    };
    take(cache.forces, record.force, record.hasForce);
    take(cache.meanAccelerations, record.meanAcceleration, record.hasMeanAcceleration);
    take(cache.evaluator.list().builtAt, record.builtAt, record.isListed);
    return record;
}

/// Sends what toRecord(simulation, index) returns of each particle to the rank that rankOf(position) names.
template <class Record, class RankOf>
std::vector<Record> sendParticles(const Ranks& ranks, const Simulation& simulation,
                                  Record (*toRecord)(const Simulation&, std::size_t), const RankOf& rankOf) {
    std::vector<std::vector<Record>> toRanks(static_cast<std::size_t>(ranks.count()));
    for (std::size_t p = 0; p < simulation.particles.count(); ++p)
        toRanks[static_cast<std::size_t>(rankOf(simulation.particles.position[p]))].push_back(toRecord(simulation, p));
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

/// Replaces particles by those of some records, without touching the id of the next one. Calls visit(record) for each
/// record, in the order of the particles.
template <class Record, class Visit>
void replaceParticles(Particles& particles, const std::vector<Record>& records, const Visit& visit) {
    const std::uint32_t nextId = particles.nextId;
    forEachArray(particles, [&](auto& array) {
        array.clear();
        array.reserve(records.size());
    });
    inOrder(records, [&](const Record& record) {
        append(particles, record.particle);
        particles.id.back() = record.id;
        visit(record);
    });
    particles.nextId = nextId;
}

/// Replaces the particles of a simulation, with what belongs to them; returns where they were when the neighbor list
/// was built.
std::vector<Vec3> replaceParticles(Simulation& simulation, const std::vector<MigrationRecord>& records) {
    StepCache& cache = *simulation.cache;
    cache.forces.clear();
    cache.meanAccelerations.clear();
    cache.clearance.clear();
    cache.cachedNeighbors.clear();
    std::vector<Vec3> builtAt;
    replaceParticles(simulation.particles, records, [&](const MigrationRecord& record) {
        // The newest particles may have none of these.
        if (record.hasForce) cache.forces.push_back(record.force);
        if (record.hasMeanAcceleration) cache.meanAccelerations.push_back(record.meanAcceleration);
        if (record.isListed) builtAt.push_back(record.builtAt);
    });
    return builtAt;
}

/// Makes the simulation go on with other particles.
/// @param cutoff  with the skin, both in meters, of the neighbor list
void continueWith(Simulation& simulation, const std::vector<MigrationRecord>& records, double cutoff, double skin) {
    const std::vector<Vec3> builtAt = replaceParticles(simulation, records);
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
    whole.heat = simulation.heat;
    whole.agitation = simulation.agitation;
    whole.loads = simulation.loads;
    whole.particles.nextId = simulation.particles.nextId;
}

int rankZero(const Vec3& /*position*/) {
    return 0;
}

}  // namespace

void redistribute(Simulation& simulation) {
    const Ranks& ranks = *simulation.ranks;
    const auto ownerOf = [&](const Vec3& position) { return ranks.ownerOf(position); };
    const auto records = sendParticles(ranks, simulation, migrationRecordOf, ownerOf);
    const NeighborList& list = simulation.cache->evaluator.list();
    continueWith(simulation, records, list.cutoff, list.skin);
}

void gather(const Simulation& simulation, Simulation& whole) {
    const Ranks& ranks = *simulation.ranks;
    const auto records = sendParticles(ranks, simulation, recordOf, rankZero);
    const std::uint64_t held = sumOfAll(ranks, simulation.steps.held);
    if (ranks.own() != 0) return;
    copyCommon(simulation, whole);
    whole.steps.held = held;
    whole.cache->invalidate();
    replaceParticles(whole.particles, records, [](const ParticleRecord&) {});
}

std::vector<std::uint8_t> gatherCheckpoint(const Simulation& simulation) {
    const Ranks& ranks = *simulation.ranks;
    const auto records = sendParticles(ranks, simulation, migrationRecordOf, rankZero);
    const std::uint64_t held = sumOfAll(ranks, simulation.steps.held);
    TwinRun twin = gatherTwin(ranks, simulation.automatic.twin);
    if (ranks.own() != 0) return {};
    Simulation whole;
    copyCommon(simulation, whole);
    whole.setup.materials = simulation.setup.materials;
    whole.automatic.twin = std::move(twin);
    whole.steps.held = held;
    const std::vector<Vec3> builtAt = replaceParticles(whole, records);
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
    const auto records = sendParticles(ranks, simulation, migrationRecordOf, ownerOf);
    simulation.ranks = &ranks;
    const Setup& setup = simulation.setup;
    simulation.cache->evaluator = ForceEvaluator(forceFieldOf(setup), setup.forces, setup.precision, ranks);
    continueWith(simulation, records, reach[0], reach[1]);
}

}  // namespace engine
