// Encodes and decodes checkpoints. The same functions list the stored members for writing and for reading. A state that
// was read is validated before any of its numbers is used as an index.
#include "engine/run/checkpoint.h"

#include <bit>
#include <cmath>
#include <cstring>
#include <type_traits>

#include "engine/core/hash.h"
#include "engine/run/advance.h"
#include "engine/run/state_validation.h"
#include "engine/stepping/free_groups.h"
#include "engine/stepping/step_cache.h"

namespace engine {
namespace {

static_assert(std::endian::native == std::endian::little, "checkpoints are little-endian");

/// Version of the checkpoint format: kCheckpointMark in ASCII and a digit or capital, another for every change of
/// what is stored.
constexpr std::uint64_t kFormat = 0x45504B434C424C47;

constexpr std::size_t kChecksumBytes = 8;

/// Smallest reach of a neighbor list that a checkpoint may have, m. With smaller cells the indices of the cell grid
/// could not span the world.
constexpr double kLeastReach = 1e-9;

template <class Value>
concept Number = std::is_arithmetic_v<Value> || std::is_enum_v<Value>;

/// Appends the bytes of values to a buffer.
class Writer {
 public:
    static constexpr bool kReads = false;

    template <class... Values>
    void operator()(const Values&... values) {
        (write(values), ...);
    }

    std::vector<std::uint8_t> finish() {
        write(fnv1aOf(bytes_));
        return std::move(bytes_);
    }

 private:
    void write(const Number auto& number) { append(&number, sizeof number); }

    template <class Item>
    void write(const std::vector<Item>& items) {
        static_assert(std::is_same_v<Item, Vec3> || std::is_arithmetic_v<Item>);
        write(std::uint64_t{items.size()});
        append(items.data(), items.size() * sizeof(Item));
    }

    void append(const void* from, std::size_t size) {
        const auto* const first = static_cast<const std::uint8_t*>(from);
        bytes_.insert(bytes_.end(), first, first + size);
    }

    std::vector<std::uint8_t> bytes_;
};

/// Takes the values back from the bytes, in the order in which they were written.
class Reader {
 public:
    static constexpr bool kReads = true;

    explicit Reader(std::span<const std::uint8_t> bytes) : bytes_(bytes) {
        if (bytes.size() < kChecksumBytes) throw CheckpointError("it is truncated");
        bytes_ = bytes.first(bytes.size() - kChecksumBytes);
        std::uint64_t checksum = 0;
        std::memcpy(&checksum, bytes.data() + bytes_.size(), kChecksumBytes);
        if (checksum != fnv1aOf(bytes_)) throw CheckpointError("its checksum is wrong: it is damaged or truncated");
    }

    template <class... Values>
    void operator()(Values&... values) {
        (read(values), ...);
    }

    void finish() const {
        if (!bytes_.empty()) throw CheckpointError("something follows its end");
    }

 private:
    void read(Number auto& number) { take(&number, sizeof number); }

    /// No other byte than 0 or 1 is a bool, whatever a damaged file contains.
    void read(bool& truth) {
        std::uint8_t byte = 0;
        read(byte);
        truth = byte != 0;
    }

    template <class Item>
    void read(std::vector<Item>& items) {
        std::uint64_t count = 0;
        read(count);
        if (count > bytes_.size() / sizeof(Item)) throw CheckpointError("it is truncated");
        items.resize(static_cast<std::size_t>(count));
        take(items.data(), items.size() * sizeof(Item));
    }

    void take(void* to, std::size_t size) {
        if (size > bytes_.size()) throw CheckpointError("it is truncated");
        if (size > 0) std::memcpy(to, bytes_.data(), size);
        bytes_ = bytes_.subspan(size);
    }

    std::span<const std::uint8_t> bytes_;
};

// The functions below pass every member of the state to an archive, which is a Reader or a Writer. The part of the
// state is const where the archive writes.

template <class Archive, class Optional>
void exchangeOptional(Archive& archive, Optional& value) {
    bool exists = value.has_value();
    archive(exists);
    if constexpr (Archive::kReads) value = exists ? Optional(0.0) : Optional();
    if (exists) archive(*value);
}

/// The setup determines the numbers of emitters and schedules, so these are not stored.
template <class Archive, class Emitters>
void exchangeEmitters(Archive& archive, Emitters& emitters) {
    for (auto& emitter : emitters) {
        for (auto& schedule : emitter.schedules)
            archive(schedule.origin, schedule.due, schedule.births, schedule.delayed);
        archive(emitter.births);
    }
}

template <class Archive, class State>
void exchangeAutomatic(Archive& archive, State& state) {
    for (auto& steps : state.controls)
        archive(steps.step, steps.stepBefore, steps.ratioBefore, steps.calibration, steps.isCalibrated);
    auto& twin = state.twin;
    archive(twin.exists, twin.stepper, twin.start, twin.end, twin.step, twin.estimate, twin.cost);
    archive(twin.runCost, twin.runEstimate);
    archive(state.intervalCount, state.twinCount, state.lastTwin, state.nextTwin, state.nextCandidate);
    archive(state.runCostPerSecond, state.costAtTwin, state.isLimited, state.isSecond, state.lastCandidate);
    archive(state.errorSum, state.largestError, state.estimateCost);
}

template <class Archive, class Statistics>
void exchangeStatistics(Archive& archive, Statistics& steps) {
    archive(steps.count, steps.shortest, steps.longest, steps.forceEvaluations, steps.matrices, steps.products,
            steps.rejected, steps.held);
    for (auto& count : steps.limitedBy) archive(count);
    for (auto& count : steps.takenBy) archive(count);
}

/// Passes on what is not of a particle, without the neighbor list.
template <class Archive, class State>
void exchangeCommon(Archive& archive, State& simulation) {
    archive(simulation.particles.nextId);
    exchangeEmitters(archive, simulation.emitters);
    archive(simulation.removedCount, simulation.largestCountBeforeRemoval, simulation.time, simulation.stepper);
    archive(simulation.cache->forcesCurrent);
    exchangeOptional(archive, simulation.cache->energy);
    archive(simulation.cache->kinetic, simulation.cache->lastStep);
    archive(simulation.restriction.seconds, simulation.restriction.reason, simulation.restriction.passed);
    exchangeAutomatic(archive, simulation.automatic);
    exchangeStatistics(archive, simulation.steps);
    archive(simulation.wallDepths.deepest, simulation.wallDepths.centersOutside);
    auto& heat = simulation.heat;
    archive(heat.exchangeCount, heat.pending, heat.received, heat.damped, heat.ofMelting);
    archive(simulation.agitation.count, simulation.agitation.work);
    for (auto& load : simulation.loads) {
        for (int axis = 0; axis < 3; ++axis) archive(load.impulse[axis], load.angularImpulse[axis]);
        archive(load.work);
    }
}

/// Passes on everything but the neighbor list.
template <class Archive, class State>
void exchange(Archive& archive, State& simulation) {
    forEachArray(simulation.particles, archive);
    archive(simulation.cache->forces, simulation.cache->meanAccelerations);
    archive(simulation.automatic.twin.position, simulation.automatic.twin.id);
    exchangeCommon(archive, simulation);
}

/// Hash of the numbers of materials, emitters and schedules: a checkpoint fits a setup only if the hashes agree.
std::uint64_t shapeOf(const Simulation& simulation) {
    std::uint64_t hash = fnv1a(simulation.setup.materials.size(), kFormat);
    for (const EmitterState& state : simulation.emitters) hash = fnv1a(state.schedules.size(), hash);
    return fnv1a(simulation.loads.size(), hash);
}

void require(bool condition, const char* otherwise) {
    if (!condition) throw CheckpointError(otherwise);
}

}  // namespace

std::vector<std::uint8_t> encodeCommon(const Simulation& simulation) {
    Writer writer;
    exchangeCommon(writer, simulation);
    return writer.finish();
}

void decodeCommon(std::span<const std::uint8_t> bytes, Simulation& simulation) {
    Reader reader(bytes);
    exchangeCommon(reader, simulation);
    reader.finish();
}

std::vector<std::uint8_t> encodeCheckpoint(const Simulation& simulation) {
    const NeighborList& list = simulation.cache->evaluator.list();
    return encodeCheckpoint(simulation, {list.builtAt, list.cutoff, list.skin});
}

std::vector<std::uint8_t> encodeCheckpoint(const Simulation& simulation, const ListOrigin& list) {
    Writer writer;
    writer(kFormat, shapeOf(simulation));
    exchange(writer, simulation);
    writer(list.builtAt, list.cutoff, list.skin);
    return writer.finish();
}

Simulation decodeCheckpoint(const Setup& setup, std::span<const std::uint8_t> bytes) {
    Reader reader(bytes);
    Simulation simulation = start(setup);
    std::uint64_t format = 0;
    std::uint64_t shape = 0;
    reader(format);
    require(format == kFormat, "it is of another version of the program");
    reader(shape);
    require(shape == shapeOf(simulation), "it is of another scene");
    exchange(reader, simulation);
    if (const char* const flaw = stateError(simulation)) throw CheckpointError(flaw);
    renewGroups(simulation);
    std::vector<Vec3> builtAt;
    double cutoff = 0.0;
    double skin = 0.0;
    reader(builtAt, cutoff, skin);
    reader.finish();
    const bool isReachValid =
        cutoff >= 0.0 && skin >= 0.0 && std::isfinite(cutoff + skin) && cutoff + skin > kLeastReach;
    require(isInWorld(builtAt) && builtAt.size() <= simulation.particles.count() && (builtAt.empty() || isReachValid),
            "it has a corrupt neighbor list");
    simulation.cache->evaluator.restoreList(simulation.particles, builtAt, cutoff, skin);
    return simulation;
}

}  // namespace engine
