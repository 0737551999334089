// Of those in float, compiled once per instruction set, a particle's coordinates are three of four lanes; where vectors
// have fewer, they are taken one by one.
#include "engine/forces/pack_particles.h"

#include <cstddef>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/forces/pack_particles.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace engine {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

#if HWY_MAX_BYTES >= 32
/// packFloat() over lanes.
class FloatPacker {
    static_assert(offsetof(PackedParticleFloat, id) == 12 && offsetof(PackedParticleFloat, rest) == 28);
    static constexpr hn::CappedTag<double, 4> kTag{};
    static constexpr hn::RebindToUnsigned<decltype(kTag)> kBits{};
    static constexpr hn::Rebind<std::uint32_t, decltype(kTag)> kWhole{};
    static constexpr hn::Rebind<float, decltype(kTag)> kFloat{};
    using V = hn::Vec<decltype(kTag)>;

 public:
    explicit FloatPacker(double perMeter) : perMeter_(hn::Set(kTag, perMeter)) {}

    HWY_INLINE void write(const SortedParticles& from, std::size_t p, PackedParticleFloat& record) const {
        const Vec3& position = from.position[p];
        const auto velocity = hn::BitCast(kWhole, hn::DemoteTo(kFloat, three(from.velocity[p])));
        auto* const to = reinterpret_cast<std::uint32_t*>(&record);
        hn::Store(hn::InsertLane(toFixedPoint(position), 3, from.id[p]), kWhole, to);
        const std::uint32_t rest = lowBits(position.x(), position.y(), position.z());
        hn::Store(hn::InsertLane(velocity, 3, rest), kWhole, to + 4);
    }

 private:
    static V three(const Vec3& vector) { return hn::MaskedLoad(hn::FirstN(kTag, 3), kTag, vector.data()); }

    hn::Vec<decltype(kWhole)> toFixedPoint(const Vec3& position) const {
        const V units = hn::Mul(three(position), perMeter_);
        const V rounding = hn::Set(kTag, kWholeRounding);
        const V turns = hn::Sub(hn::Add(hn::Mul(units, hn::Set(kTag, 1.0 / kWordTurn)), rounding), rounding);
        const V rest = hn::Sub(units, hn::Mul(turns, hn::Set(kTag, kWordTurn)));
        return hn::TruncateTo(kWhole, hn::BitCast(kBits, hn::Add(rest, rounding)));
    }

    V perMeter_;
};
#else
class FloatPacker {
 public:
    explicit FloatPacker(double perMeter) : perMeter_(perMeter) {}

    void write(const SortedParticles& from, std::size_t p, PackedParticleFloat& record) const {
        record = packFloat(from.position[p], from.velocity[p], from.id[p], perMeter_);
    }

 private:
    double perMeter_;
};
#endif

void packFloatsHere(const SortedParticles& of, double perMeter, std::size_t begin, std::size_t end,
                    PackedParticleFloat* all) {
    const SortedParticles from = of;  // nothing that is written is block of it
    const FloatPacker writer(perMeter);
    for (std::size_t sortedIndex = begin; sortedIndex < end; ++sortedIndex) {
        writer.write(from, from.order[sortedIndex], all[sortedIndex]);
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace engine
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace engine {

HWY_EXPORT(packFloatsHere);

void packDoubles(const SortedParticles& of, std::size_t begin, std::size_t end, PackedParticle* all) {
    const SortedParticles from = of;  // nothing that is written is block of it
    for (std::size_t sortedIndex = begin; sortedIndex < end; ++sortedIndex) {
        all[sortedIndex] = packDouble(from, from.order[sortedIndex]);
    }
}

void packFloats(const SortedParticles& from, double perMeter, std::size_t begin, std::size_t end,
                PackedParticleFloat* all) {
    HWY_DYNAMIC_DISPATCH(packFloatsHere)(from, perMeter, begin, end, all);
}

}  // namespace engine

#endif
