// How the SIMD kernels load packed particles: one neighbor of each particle of the cluster, one in each lane. Structs
// are loaded in blocks of 128 bits and transposed, which takes half the time of gather instructions. Highway
// includes this file once per instruction set, hence the unusual include guard below.
#if defined(ENGINE_SIMD_PARTICLES_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ENGINE_SIMD_PARTICLES_INL_H
#undef ENGINE_SIMD_PARTICLES_INL_H
#else
#define ENGINE_SIMD_PARTICLES_INL_H
#endif

#include <hwy/cache_control.h>

#include <algorithm>
#include <array>
#include <type_traits>

#include "engine/core/simd_vectors-inl.h"
#include "engine/forces/packed_particles.h"
#include "engine/neighbors/neighbor_rows.h"
#include "engine/neighbors/simd_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace engine {
namespace HWY_NAMESPACE {

/// Integers as wide as the numbers in the SIMD lanes.
template <class T>
using WholeTag = hn::RebindToSigned<Tag<T>>;
template <class T>
using Whole = hn::Vec<WholeTag<T>>;

/// What the law of a pair depends on, of the particles in the SIMD lanes.
template <class T>
struct Traits {
    Lanes<T> radius;    ///< m
    Whole<T> material;  ///< index of the material
};

/// Positions and velocities of the particles in the SIMD lanes.
template <class Position, class Velocity>
struct Loaded {
    Vector3<Position> position;
    Vector3<Velocity> velocity;  ///< velocity; zero where no term of the force needs it
};

/// One pair of particles in each SIMD lane: a particle of the cluster and one of its neighbors.
template <class T>
struct Row {
    Vector3<Lanes<T>> separation;  ///< separation P, in the unit of the packed coordinates
    Vector3<Lanes<T>> velocity;    ///< V, m/s
    hn::Mask<Tag<T>> isPair;       ///< false where the neighbor is only padding of a short row
};

/// Length of the longest row of neighbors among the particles in one SIMD vector, which begins at a lane slot.
template <class T>
std::uint32_t longestRow(const NeighborRows& rows, std::size_t firstSlot) {
    return *std::max_element(&rows.length[firstSlot], &rows.length[firstSlot] + hn::Lanes(Tag<T>()));
}

/// Prefetches the row entries that the loop over neighbors will read some rounds later. Measured with `globular bench
/// --filter forces` on Zen 5: a tenth less time at 256,000 particles, whose rows come from memory; nothing at 32,000.
template <class Entry>
HWY_INLINE void prefetchRows(const Entry* entry) {
    constexpr std::size_t kGroups = 96;
    hwy::Prefetch(entry + kGroups * kClusterSize);
}

#if HWY_TARGET != HWY_SCALAR
/// A SIMD vector of 128-bit blocks, one from every `every`-th struct of those in the SIMD lanes.
/// @param addressOf  returns the address of the block in the struct in a lane
template <class D, class Address>
HWY_INLINE hn::Vec<D> blocksFrom(D d, const Address& addressOf, std::size_t first, std::size_t every) {
    constexpr std::size_t kBlocks = hn::MaxLanes(D()) * sizeof(hn::TFromD<D>) / 16;
    if constexpr (kBlocks <= 1) {
        return hn::Load(d, addressOf(first));
    } else {
        const hn::Half<D> half;
        return hn::Combine(d, blocksFrom(half, addressOf, first + every * kBlocks / 2, every),
                           blocksFrom(half, addressOf, first, every));
    }
}
#endif

/// Four consecutive numbers of several structs, one struct in each SIMD lane.
template <class T>
struct Fields {
    Lanes<T> first, second, third, fourth;
};

/// Loads four consecutive numbers of the structs in the SIMD lanes. What is not used of them is not loaded.
/// @param addressOf  returns the address of the first number of the struct in a lane
template <class T, class Address>
HWY_INLINE Fields<T> fieldsAt(const Address& addressOf) {
    constexpr Tag<T> kTag{};
#if HWY_TARGET == HWY_SCALAR
    const auto field = [&](int number) { return hn::Load(kTag, addressOf(0) + number); };
    return {field(0), field(1), field(2), field(3)};
#else
    if constexpr (std::is_same_v<T, double>) {
        // Two numbers of every other struct.
        const auto addressOfSecondTwo = [&](std::size_t lane) { return addressOf(lane) + 2; };
        const auto ab0 = blocksFrom(kTag, addressOf, 0, 2), ab1 = blocksFrom(kTag, addressOf, 1, 2);
        const auto cd0 = blocksFrom(kTag, addressOfSecondTwo, 0, 2), cd1 = blocksFrom(kTag, addressOfSecondTwo, 1, 2);
        return {hn::InterleaveLower(kTag, ab0, ab1), hn::InterleaveUpper(kTag, ab0, ab1),
                hn::InterleaveLower(kTag, cd0, cd1), hn::InterleaveUpper(kTag, cd0, cd1)};
    } else {
        // Loads the four numbers of every fourth struct, then transposes four such vectors.
        constexpr hn::Repartition<double, Tag<float>> kTwos{};
        const auto lower = [&](auto a, auto b) { return hn::BitCast(kTwos, hn::InterleaveLower(kTag, a, b)); };
        const auto upper = [&](auto a, auto b) { return hn::BitCast(kTwos, hn::InterleaveUpper(kTag, a, b)); };
        const auto firsts = [&](auto a, auto b) { return hn::BitCast(kTag, hn::InterleaveLower(kTwos, a, b)); };
        const auto seconds = [&](auto a, auto b) { return hn::BitCast(kTag, hn::InterleaveUpper(kTwos, a, b)); };
        const auto a = blocksFrom(kTag, addressOf, 0, 4), b = blocksFrom(kTag, addressOf, 1, 4);
        const auto c = blocksFrom(kTag, addressOf, 2, 4), d = blocksFrom(kTag, addressOf, 3, 4);
        const auto low01 = lower(a, b), low23 = lower(c, d), high01 = upper(a, b), high23 = upper(c, d);
        return {firsts(low01, low23), seconds(low01, low23), firsts(high01, high23), seconds(high01, high23)};
    }
#endif
}

/// The same of the structs with these indices in an array of structs.
/// @param base    address of the first number in the first struct
/// @param stride  numbers from one struct to the next
template <class T>
HWY_INLINE Fields<T> fieldsOf(const T* base, std::int64_t stride, const std::int32_t* indices) {
    return fieldsAt<T>([=](std::size_t lane) { return base + stride * indices[lane]; });
}

/// Loads particles in double precision, with positions in meters.
struct DoubleLanes {
    using T = double;
    using V = Lanes<double>;
    static constexpr Tag<double> kTag{};
    static constexpr hn::Rebind<std::int32_t, Tag<double>> kIndices{};
    static constexpr hn::Rebind<std::int64_t, Tag<double>> kWide{};
    static constexpr std::int64_t kStride = sizeof(PackedParticle) / sizeof(double);

    const PackedParticle* particles;
    const double* base;  ///< address of the first packed particle
    hn::Vec<decltype(kIndices)> ownIndices;
    Loaded<V, V> own;

    DoubleLanes(const std::vector<PackedParticle>& all, const std::int32_t* indices)
        : particles(all.data()), base(&all.front().x), ownIndices(hn::LoadU(kIndices, indices)) {
        own = load<true>(indices);
    }

    template <bool needsVelocity>
    Loaded<V, V> load(const std::int32_t* indices) const {
        const Fields<double> xyzu = fieldsOf(base, kStride, indices);
        const Fields<double> vw = fieldsOf(base + 4, kStride, indices);
        const V zero = hn::Zero(kTag);
        return {{xyzu.first, xyzu.second, xyzu.third},
                needsVelocity ? Vector3<V>{xyzu.fourth, vw.first, vw.second} : Vector3<V>{zero, zero, zero}};
    }

    Traits<double> traits(const std::int32_t* indices) const {
        constexpr WholeTag<double> kWhole{};
        const Fields<double> fields = fieldsOf(base + 4, kStride, indices);
        // The material is the lower half of the last eight bytes.
        return {fields.third, hn::And(hn::BitCast(kWhole, fields.fourth), hn::Set(kWhole, 0xFFFFFFFF))};
    }

    std::uint32_t material(std::int32_t index) const { return particles[index].material; }

    /// The pairs of the own particles and the neighbors `others`, which were loaded for these indices.
    template <bool needsVelocity>
    Row<double> row(const std::int32_t* indices, const Loaded<V, V>& others) const {
        Row<double> row;
        row.isPair = hn::RebindMask(
            kTag, hn::Ne(hn::PromoteTo(kWide, hn::LoadU(kIndices, indices)), hn::PromoteTo(kWide, ownIndices)));
        row.separation = difference(own.position, others.position);
        if constexpr (needsVelocity) row.velocity = difference(own.velocity, others.velocity);
        return row;
    }

    /// Of the given pairs, whose P.P is 0, the pairs that may share their position: in double precision, all of them.
    hn::Mask<Tag<double>> sharePosition(const std::int32_t* /*indices*/, hn::Mask<Tag<double>> pairs) const {
        return pairs;
    }
};

/// Loads particles in single precision. Positions are fixed-point numbers modulo 2^32, whose differences are exact
/// anywhere in the world; separations are in the same fixed-point units.
struct FloatLanes {
    using T = float;
    using V = Lanes<float>;
    static constexpr Tag<float> kTag{};
    static constexpr WholeTag<float> kWhole{};
    using I = Whole<float>;
    static constexpr std::int64_t kStride = sizeof(PackedParticleFloat) / sizeof(float);

    const PackedFloats& all;
    const float* base;  ///< address of the first packed particle; its positions are bits of integers
    I ownIndices;
    Loaded<I, V> own;

    FloatLanes(const PackedFloats& floats, const std::int32_t* indices)
        : all(floats),
          base(reinterpret_cast<const float*>(floats.particles.data())),
          ownIndices(hn::LoadU(kWhole, indices)) {
        own = load<true>(indices);
    }

    template <bool needsVelocity>
    Loaded<I, V> load(const std::int32_t* indices) const {
        const auto whole = [](V bits) { return hn::BitCast(kWhole, bits); };
        const Fields<float> xyz = fieldsOf(base, kStride, indices);
        const Fields<float> uvw = fieldsOf(base + 4, kStride, indices);
        const V zero = hn::Zero(kTag);
        return {{whole(xyz.first), whole(xyz.second), whole(xyz.third)},
                needsVelocity ? Vector3<V>{uvw.first, uvw.second, uvw.third} : Vector3<V>{zero, zero, zero}};
    }

    Traits<float> traits(const std::int32_t* indices) const {
        return {fieldsOf(base, kStride, indices).fourth,
                hn::BitCast(kWhole, fieldsOf(base + 4, kStride, indices).fourth)};
    }

    std::uint32_t material(std::int32_t index) const { return all.particles[static_cast<std::size_t>(index)].material; }

    /// The pairs of the own particles and the neighbors `others`, which were loaded for these indices.
    template <bool needsVelocity>
    Row<float> row(const std::int32_t* indices, const Loaded<I, V>& others) const {
        Row<float> row;
        row.isPair = hn::RebindMask(kTag, hn::Ne(hn::LoadU(kWhole, indices), ownIndices));
        const Vector3<I> units = difference(own.position, others.position);
        row.separation = {hn::ConvertTo(kTag, units.x), hn::ConvertTo(kTag, units.y), hn::ConvertTo(kTag, units.z)};
        if constexpr (needsVelocity) row.velocity = difference(own.velocity, others.velocity);
        return row;
    }

    /// Of the given pairs, whose P.P is 0, the pairs that share their position; the other pairs are less than a unit
    /// apart.
    hn::Mask<Tag<float>> sharePosition(const std::int32_t* indices, hn::Mask<Tag<float>> pairs) const {
        std::array<std::uint8_t, 8> bits = {};
        std::array<std::int32_t, kClusterSize> own32;
        hn::StoreU(ownIndices, kWhole, own32.data());
        hn::StoreMaskBits(kTag, pairs, bits.data());
        for (std::size_t lane = 0; lane < hn::Lanes(kTag); ++lane)
            if (!all.coincide(static_cast<std::size_t>(own32[lane]), static_cast<std::size_t>(indices[lane])))
                bits[lane / 8] &= static_cast<std::uint8_t>(~(1U << lane % 8));
        return hn::LoadMaskBits(kTag, bits.data());
    }
};

}  // namespace HWY_NAMESPACE
}  // namespace engine
HWY_AFTER_NAMESPACE();

#endif
