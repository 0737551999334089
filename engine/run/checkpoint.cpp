// One function lists what is stored, for both directions. What is read is checked before anything is indexed by it.
#include "engine/run/checkpoint.h"

#include <bit>
#include <cmath>
#include <cstring>
#include <type_traits>

#include "engine/core/hash.h"
#include "engine/run/advance.h"
#include "engine/run/state_validation.h"
#include "engine/stepping/step_cache.h"

namespace engine {
namespace {

static_assert(std::endian::native == std::endian::little, "checkpoints are little-endian");

/// Changed whenever what is stored changes.
constexpr std::uint64_t kFormat = 0x35504B434C424C47;  // "GLBLCKP5"

constexpr std::size_t kChecksumBytes = 8;

/// Smallest reach of a neighbor list that is accepted, m: in cells any smaller the world would not fit the cell grid's
/// numbers.
constexpr double kLeastReach = 1e-9;

class Writer {
 public:
    static constexpr bool kReads = false;

    template <class Number>
    requires std::is_arithmetic_v<Number> || std::is_enum_v<Number>
    void operator()(const Number& number) { append(&number, sizeof number); }

    template <class Item>
    void operator()(const std::vector<Item>& items) {
        static_assert(std::is_same_v<Item, Vec3> || std::is_arithmetic_v<Item>);
        (*this)(static_cast<std::uint64_t>(items.size()));
        append(items.data(), items.size() * sizeof(Item));
    }

    std::vector<std::uint8_t> finish() {
        (*this)(fnv1aOf(bytes_));
        return std::move(bytes_);
    }

 private:
    void append(const void* from, std::size_t size) {
        const auto* const first = static_cast<const std::uint8_t*>(from);
        bytes_.insert(bytes_.end(), first, first + size);
    }

    std::vector<std::uint8_t> bytes_;
};

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

    template <class Number>
    requires std::is_arithmetic_v<Number> || std::is_enum_v<Number>
    void operator()(Number& number) {
        if constexpr (std::is_same_v<Number, bool>) {
            std::uint8_t byte = 0;
            take(&byte, 1);
            number = byte != 0;
        } else {
            take(&number, sizeof number);
        }
    }

    template <class Item>
    void operator()(std::vector<Item>& items) {
        std::uint64_t count = 0;
        (*this)(count);
        if (count > bytes_.size() / sizeof(Item)) throw CheckpointError("it is truncated");
        items.resize(static_cast<std::size_t>(count));
        take(items.data(), items.size() * sizeof(Item));
    }

    void finish() const {
        if (!bytes_.empty()) throw CheckpointError("something follows its end");
    }

 private:
    void take(void* to, std::size_t size) {
        if (size > bytes_.size()) throw CheckpointError("it is truncated");
        if (size > 0) std::memcpy(to, bytes_.data(), size);
        bytes_ = bytes_.subspan(size);
    }

    std::span<const std::uint8_t> bytes_;
};

template <class Archive, class Optional>
void exchangeOptional(Archive& archive, Optional& value) {
    bool exists = value.has_value();
    archive(exists);
    if constexpr (Archive::kReads) value = exists ? Optional(0.0) : Optional();
    if (exists) archive(*value);
}

template <class Archive, class Items>
void exchangeEach(Archive& archive, Items& items) {
    for (auto& item : items) archive(item);
}

template <class Archive, class Of>
void exchangeParticles(Archive& archive, Of& particles) {
    archive(particles.position);
    archive(particles.velocity);
    archive(particles.radius);
    archive(particles.mass);
    archive(particles.birthTime);
    archive(particles.material);
    archive(particles.id);
    archive(particles.nextId);
}

/// The set-up determines the numbers of emitters and schedules, so these are not stored.
template <class Archive, class Of>
void exchangeEmitters(Archive& archive, Of& emitters) {
    for (auto& emitter : emitters) {
        for (auto& schedule : emitter.schedules) {
            archive(schedule.origin);
            archive(schedule.due);
            archive(schedule.births);
            archive(schedule.delayed);
        }
        archive(emitter.births);
        archive(emitter.refusals);
    }
}

template <class Archive, class Of>
void exchangeAutomatic(Archive& archive, Of& state) {
    for (auto& choice : state.choices) {
        archive(choice.step);
        archive(choice.cost);
        archive(choice.reason);
        archive(choice.growth);
        archive(choice.followed);
    }
    archive(state.intervalCount);
    archive(state.nextEstimate);
    archive(state.estimateCount);
    archive(state.errorSum);
    archive(state.largestError);
    archive(state.rmsAcceleration);
    archive(state.estimateCost);
}

template <class Archive, class Of>
void exchangeStatistics(Archive& archive, Of& steps) {
    archive(steps.count);
    archive(steps.shortest);
    archive(steps.longest);
    archive(steps.forceEvaluations);
    archive(steps.products);
    archive(steps.rejected);
    exchangeEach(archive, steps.limitedBy);
    exchangeEach(archive, steps.takenBy);
}

/// Everything but the neighbor list. Of is Simulation, const where the archive writes.
template <class Archive, class Of>
void exchange(Archive& archive, Of& simulation) {
    exchangeParticles(archive, simulation.particles);
    exchangeEmitters(archive, simulation.emitters);
    archive(simulation.removedCount);
    archive(simulation.largestCountBeforeRemoval);
    archive(simulation.time);
    archive(simulation.stepper);
    archive(simulation.cache->forces);
    archive(simulation.cache->forcesCurrent);
    exchangeOptional(archive, simulation.cache->energy);
    archive(simulation.cache->kinetic);
    archive(simulation.restriction.seconds);
    archive(simulation.restriction.reason);
    archive(simulation.restriction.passed);
    exchangeAutomatic(archive, simulation.automatic);
    exchangeStatistics(archive, simulation.steps);
}

/// A hash that is equal for set-ups whose states have the same layout.
std::uint64_t shapeOf(const Simulation& simulation) {
    std::uint64_t hash = fnv1a(simulation.setup.materials.size(), kFormat);
    for (const EmitterState& state : simulation.emitters) hash = fnv1a(state.schedules.size(), hash);
    return hash;
}

void require(bool condition, const char* otherwise) {
    if (!condition) throw CheckpointError(otherwise);
}

}  // namespace

std::vector<std::uint8_t> encodeCheckpoint(const Simulation& simulation) {
    Writer writer;
    writer(kFormat);
    writer(shapeOf(simulation));
    exchange(writer, simulation);
    writer(simulation.cache->evaluator.list().builtAt);
    writer(simulation.cache->evaluator.list().reach);
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
    std::vector<Vec3> builtAt;
    double reach = 0.0;
    reader(builtAt);
    reader(reach);
    reader.finish();
    require(isInWorld(builtAt) && (builtAt.empty() || (std::isfinite(reach) && reach > kLeastReach)),
            "it has a corrupt neighbor list");
    simulation.cache->evaluator.restoreList(builtAt, reach);
    return simulation;
}

}  // namespace engine
