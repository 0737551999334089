// Particles as lanes: how the kernels on vector units read packed. Included once per instruction set, by Highway's
// rules; the guard below is theirs.
#if defined(ENGINE_SIMD_RECORDS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ENGINE_SIMD_RECORDS_INL_H
#undef ENGINE_SIMD_RECORDS_INL_H
#else
#define ENGINE_SIMD_RECORDS_INL_H
#endif

#include <algorithm>
#include <array>

#include "engine/core/simd_vectors-inl.h"
#include "engine/forces/packed_particle.h"
#include "engine/neighbors/neighbor_rows.h"
#include "engine/neighbors/simd_blocks-inl.h"

HWY_BEFORE_NAMESPACE();
namespace engine {
namespace HWY_NAMESPACE {

/// What a row of sortedIndices refers to, as it was read.
template <class Position, class Velocity>
struct Others {
    Vector3<Position> position;
    Vector3<Velocity> velocity;  ///< zero where it is not needed
};

/// Of the pairs of a row: P in units of length, V, and where there is a pair at all.
template <class T>
struct Row {
    Vector3<Lanes<T>> separation, velocity;
    hn::Mask<Tag<T>> isPair;
};

/// Entries of the longest row of a block of lanes.
template <class T>
std::uint32_t longestRow(const NeighborRows& rows, std::size_t first) {
    std::uint32_t longest = 0;
    for (std::size_t lane = 0; lane < hn::Lanes(Tag<T>()); ++lane)
        longest = std::max(longest, rows.length[first + lane]);
    return longest;
}

/// The particles of a block of lanes in double: positions as they are.
struct Doubles {
    using T = double;
    using V = Lanes<double>;
    static constexpr Tag<double> kTag{};
    static constexpr std::int64_t kStride = sizeof(PackedParticle) / sizeof(double);

    const double* base;    ///< of the first record that a sortedIndex of a row can mean
    Indices<double> self;  ///< sortedIndices as rows have them
    Others<V, V> own;

    /// Shape:  where the particles are among the packed; the record that sortedIndices of rows count from.
    Doubles(const PackedParticle* packed, const std::int32_t* ownIndices) : base(&packed[0].x) {
        own = load<true>(ownIndices);
        self = hn::LoadU(hn::Rebind<std::int32_t, Tag<double>>(), ownIndices);
    }

    template <bool needsVelocity>
    Others<V, V> load(const std::int32_t* sortedIndices) const {
        Vector3<V> x;
        Vector3<V> v{hn::Zero(kTag), hn::Zero(kTag), hn::Zero(kTag)};
#if HWY_TARGET == HWY_SCALAR
        const auto field = [&](int of) { return hn::Load(kTag, base + kStride * sortedIndices[0] + of); };
        x = {field(0), field(1), field(2)};
        if constexpr (needsVelocity) v = {field(3), field(4), field(5)};
#else
        // Numbers two by two, of every other record from one on.
        const auto pairs = [](const double* field, const std::int32_t* from) {
            return blocksFrom(kTag, field, kStride, from, 2);
        };
        const V xy0 = pairs(base, sortedIndices), xy1 = pairs(base, sortedIndices + 1);
        const V zu0 = pairs(base + 2, sortedIndices), zu1 = pairs(base + 2, sortedIndices + 1);
        x = {hn::InterleaveLower(kTag, xy0, xy1), hn::InterleaveUpper(kTag, xy0, xy1),
             hn::InterleaveLower(kTag, zu0, zu1)};
        if constexpr (needsVelocity) {
            const V vw0 = pairs(base + 4, sortedIndices), vw1 = pairs(base + 4, sortedIndices + 1);
            v = {hn::InterleaveUpper(kTag, zu0, zu1), hn::InterleaveLower(kTag, vw0, vw1),
                 hn::InterleaveUpper(kTag, vw0, vw1)};
        }
#endif
        return {x, v};
    }

    template <bool needsVelocity>
    Row<double> row(const std::int32_t* sortedIndices, const Others<V, V>& others) const {
        const hn::Rebind<std::int64_t, Tag<double>> kWide;
        Row<double> row;
        row.isPair = hn::RebindMask(
            kTag, hn::Ne(hn::PromoteTo(kWide, hn::LoadU(hn::Rebind<std::int32_t, Tag<double>>(), sortedIndices)),
                         hn::PromoteTo(kWide, self)));
        row.separation = difference(own.position, others.position);
        if constexpr (needsVelocity) row.velocity = difference(own.velocity, others.velocity);
        return row;
    }

    /// Of pairs of a row without separation those that share their position: all, or nearly.
    hn::Mask<Tag<double>> sharePlace(const std::int32_t* /*sortedIndices*/, hn::Mask<Tag<double>> pairs) const {
        return pairs;
    }
};

/// In float: positions are whole numbers of a unit, modulo 2^32, whose differences are exact anywhere in the world, and
/// separations stay in it.
struct Singles {
    using T = float;
    using V = Lanes<float>;
    using I = Indices<float>;
    static constexpr Tag<float> kTag{};
    static constexpr hn::Rebind<std::int32_t, Tag<float>> kWhole{};
    static constexpr std::int64_t kStride = sizeof(PackedParticleFloat) / sizeof(float);

    const PackedParticleFloat* packed;  ///< the first that a sortedIndex of a row can mean
    const float* base;                  ///< the same; positions are bits of integers
    I self;                             ///< sortedIndices as rows have them
    Others<I, V> own;

    /// Shape:  as Doubles has it.
    Singles(const PackedParticleFloat* all, const std::int32_t* ownIndices)
        : packed(all), base(reinterpret_cast<const float*>(all)) {
        own = load<true>(ownIndices);
        self = hn::LoadU(kWhole, ownIndices);
    }

    template <bool needsVelocity>
    Others<I, V> load(const std::int32_t* sortedIndices) const {
        Vector3<I> x;
        Vector3<V> v{hn::Zero(kTag), hn::Zero(kTag), hn::Zero(kTag)};
        const auto whole = [](V bits) { return hn::BitCast(kWhole, bits); };
#if HWY_TARGET == HWY_SCALAR
        const auto field = [&](int of) { return hn::Load(kTag, base + kStride * sortedIndices[0] + of); };
        x = {whole(field(0)), whole(field(1)), whole(field(2))};
        if constexpr (needsVelocity) v = {field(4), field(5), field(6)};
#else
        static constexpr hn::Repartition<double, Tag<float>> kTwos{};
        // What two vectors have in the lower or upper halves of their blocks.
        const auto lower = [](V a, V b) { return hn::BitCast(kTwos, hn::InterleaveLower(kTag, a, b)); };
        const auto upper = [](V a, V b) { return hn::BitCast(kTwos, hn::InterleaveUpper(kTag, a, b)); };
        const auto firsts = [](auto a, auto b) { return hn::BitCast(kTag, hn::InterleaveLower(kTwos, a, b)); };
        const auto seconds = [](auto a, auto b) { return hn::BitCast(kTag, hn::InterleaveUpper(kTwos, a, b)); };
        // Numbers four by four, of every fourth record from one on.
        const auto fours = [](const float* field, const std::int32_t* from) {
            return blocksFrom(kTag, field, kStride, from, 4);
        };
        const auto fields = [&](const float* field) {
            const V a = fours(field, sortedIndices), b = fours(field, sortedIndices + 1);
            const V c = fours(field, sortedIndices + 2), d = fours(field, sortedIndices + 3);
            const auto xy01 = lower(a, b), xy23 = lower(c, d);
            return Vector3<V>{firsts(xy01, xy23), seconds(xy01, xy23), firsts(upper(a, b), upper(c, d))};
        };
        const Vector3<V> position = fields(base);
        x = {whole(position.x), whole(position.y), whole(position.z)};
        if constexpr (needsVelocity) v = fields(base + 4);
#endif
        return {x, v};
    }

    template <bool needsVelocity>
    Row<float> row(const std::int32_t* sortedIndices, const Others<I, V>& others) const {
        Row<float> row;
        row.isPair = hn::RebindMask(kTag, hn::Ne(hn::LoadU(kWhole, sortedIndices), self));
        const Vector3<I> units = difference(own.position, others.position);
        row.separation = {hn::ConvertTo(kTag, units.x), hn::ConvertTo(kTag, units.y), hn::ConvertTo(kTag, units.z)};
        if constexpr (needsVelocity) row.velocity = difference(own.velocity, others.velocity);
        return row;
    }

    /// Of pairs of a row without separation those that share their position: others are only nearer than a unit.
    hn::Mask<Tag<float>> sharePlace(const std::int32_t* sortedIndices, hn::Mask<Tag<float>> pairs) const {
        std::array<std::uint8_t, 8> bits = {};
        std::array<std::int32_t, kClusterSize> ownIndices;
        hn::StoreU(self, kWhole, ownIndices.data());
        hn::StoreMaskBits(kTag, pairs, bits.data());
        for (std::size_t lane = 0; lane < hn::Lanes(kTag); ++lane)
            if (!coincide(packed[ownIndices[lane]], packed[sortedIndices[lane]]))
                bits[lane / 8] &= static_cast<std::uint8_t>(~(1U << lane % 8));
        return hn::LoadMaskBits(kTag, bits.data());
    }
};

}  // namespace HWY_NAMESPACE
}  // namespace engine
HWY_AFTER_NAMESPACE();

#endif
