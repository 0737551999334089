// Particles as lanes: how the kernels on vector units read records. Included once per instruction set, by Highway's
// rules; the guard below is theirs.
#if defined(ENGINE_LANE_RECORDS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ENGINE_LANE_RECORDS_INL_H
#undef ENGINE_LANE_RECORDS_INL_H
#else
#define ENGINE_LANE_RECORDS_INL_H
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <array>

#include "engine/lane_rows.h"
#include "engine/pair_record.h"

HWY_BEFORE_NAMESPACE();
namespace engine {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

template <class T>
using Tag = hn::CappedTag<T, kGroup>;
template <class T>
using Lanes = hn::Vec<Tag<T>>;
template <class T>
using Places = hn::Vec<hn::Rebind<std::int32_t, Tag<T>>>;  ///< as many as Lanes<T>

template <class V>
struct Vector3 {
    V x, y, z;
};

/// Of the pairs of a row: P, V, and where there is a pair at all.
template <class T>
struct Row {
    Vector3<Lanes<T>> separation, velocity;
    hn::Mask<Tag<T>> isPair;
};

/// The places of a block of lanes; beyond the last particle, its place again.
template <class T>
std::array<std::int32_t, kGroup> selvesFrom(std::size_t first, std::size_t count) {
    std::array<std::int32_t, kGroup> selves;
    for (std::size_t lane = 0; lane < hn::Lanes(Tag<T>()); ++lane)
        selves[lane] = static_cast<std::int32_t>(std::min(first + lane, count - 1));
    return selves;
}

/// Entries of the longest row of a block of lanes.
template <class T>
std::uint32_t longestRow(const LaneRows& rows, std::size_t first) {
    std::uint32_t longest = 0;
    for (std::size_t lane = 0; lane < hn::Lanes(Tag<T>()); ++lane)
        longest = std::max(longest, rows.length[first + lane]);
    return longest;
}

#if HWY_TARGET != HWY_SCALAR
/// Blocks of 128 bits side by side, as many as a vector has: of every so many places one record's, at the base. Loads
/// of this kind and shuffles within blocks take half of the time of gathers.
template <class D>
HWY_INLINE hn::Vec<D> blocksFrom(D d, const hn::TFromD<D>* base, std::int64_t stride, const std::int32_t* places,
                                 std::size_t every) {
    constexpr std::size_t kBlocks = hn::MaxLanes(D()) * sizeof(hn::TFromD<D>) / 16;
    if constexpr (kBlocks <= 1) {
        return hn::Load(d, base + stride * places[0]);
    } else {
        const hn::Half<D> half;
        return hn::Combine(d, blocksFrom(half, base, stride, places + every * kBlocks / 2, every),
                           blocksFrom(half, base, stride, places, every));
    }
}
#endif

/// The particles of a block of lanes in double: positions as they are.
struct Doubles {
    using T = double;
    using V = Lanes<double>;
    static constexpr Tag<double> kTag{};
    static constexpr std::int64_t kStride = sizeof(PairRecord) / sizeof(double);

    const double* base;  ///< of the first record
    Places<double> self;
    Vector3<V> position, velocity;

    Doubles(const PairRecord* records, const std::int32_t* places)
        : base(&records[0].x), self(hn::LoadU(hn::Rebind<std::int32_t, Tag<double>>(), places)) {
        load<true>(places, position, velocity);
    }

    template <bool needsVelocity>
    void load(const std::int32_t* places, Vector3<V>& x, Vector3<V>& v) const {
#if HWY_TARGET == HWY_SCALAR
        const auto field = [&](int of) { return hn::Load(kTag, base + kStride * places[0] + of); };
        x = {field(0), field(1), field(2)};
        if constexpr (needsVelocity) v = {field(3), field(4), field(5)};
#else
        // Numbers two by two, of every other record from one on.
        const auto pairs = [](const double* field, const std::int32_t* from) {
            return blocksFrom(kTag, field, kStride, from, 2);
        };
        const V xy0 = pairs(base, places), xy1 = pairs(base, places + 1);
        const V zu0 = pairs(base + 2, places), zu1 = pairs(base + 2, places + 1);
        x = {hn::InterleaveLower(kTag, xy0, xy1), hn::InterleaveUpper(kTag, xy0, xy1),
             hn::InterleaveLower(kTag, zu0, zu1)};
        if constexpr (needsVelocity) {
            const V vw0 = pairs(base + 4, places), vw1 = pairs(base + 4, places + 1);
            v = {hn::InterleaveUpper(kTag, zu0, zu1), hn::InterleaveLower(kTag, vw0, vw1),
                 hn::InterleaveUpper(kTag, vw0, vw1)};
        }
#endif
    }

    template <bool needsVelocity>
    Row<double> row(const std::int32_t* others) const {
        const hn::Rebind<std::int64_t, Tag<double>> wide;
        const hn::Rebind<std::int32_t, Tag<double>> narrow;
        Vector3<V> x, v;
        load<needsVelocity>(others, x, v);
        Row<double> row;
        row.isPair =
            hn::RebindMask(kTag, hn::Ne(hn::PromoteTo(wide, hn::LoadU(narrow, others)), hn::PromoteTo(wide, self)));
        row.separation = {hn::Sub(position.x, x.x), hn::Sub(position.y, x.y), hn::Sub(position.z, x.z)};
        if constexpr (needsVelocity)
            row.velocity = {hn::Sub(velocity.x, v.x), hn::Sub(velocity.y, v.y), hn::Sub(velocity.z, v.z)};
        return row;
    }
};

/// In float: positions are whole numbers of a unit, modulo 2^32, whose differences are exact anywhere in the world.
struct Singles {
    using T = float;
    using V = Lanes<float>;
    using I = Places<float>;
    static constexpr Tag<float> kTag{};
    static constexpr hn::Rebind<std::int32_t, Tag<float>> kWhole{};
    static constexpr std::int64_t kStride = sizeof(SinglePrecisionRecord) / sizeof(float);

    const float* base;  ///< of the first record; its positions are bits of integers
    I self;
    Vector3<I> position;
    Vector3<V> velocity;
    V unit;

    Singles(const SinglePrecisionRecord* records, double unitLength, const std::int32_t* places)
        : base(reinterpret_cast<const float*>(records)), self(hn::LoadU(kWhole, places)) {
        load<true>(places, position, velocity);
        unit = hn::Set(kTag, static_cast<float>(unitLength));
    }

    template <bool needsVelocity>
    void load(const std::int32_t* places, Vector3<I>& x, Vector3<V>& v) const {
        const auto whole = [](V bits) { return hn::BitCast(kWhole, bits); };
#if HWY_TARGET == HWY_SCALAR
        const auto field = [&](int of) { return hn::Load(kTag, base + kStride * places[0] + of); };
        x = {whole(field(0)), whole(field(1)), whole(field(2))};
        if constexpr (needsVelocity) v = {field(3), field(4), field(5)};
#else
        static constexpr hn::Repartition<double, Tag<float>> kTwos{};
        // Numbers four by four, of every fourth record from one on, and what two of these have in their lower or upper
        // halves.
        const auto fours = [](const float* field, const std::int32_t* from) {
            return blocksFrom(kTag, field, kStride, from, 4);
        };
        const auto lower = [](V a, V b) { return hn::BitCast(kTwos, hn::InterleaveLower(kTag, a, b)); };
        const auto upper = [](V a, V b) { return hn::BitCast(kTwos, hn::InterleaveUpper(kTag, a, b)); };
        const auto firsts = [](auto a, auto b) { return hn::BitCast(kTag, hn::InterleaveLower(kTwos, a, b)); };
        const auto seconds = [](auto a, auto b) { return hn::BitCast(kTag, hn::InterleaveUpper(kTwos, a, b)); };
        const V xyzu0 = fours(base, places), xyzu1 = fours(base, places + 1);
        const V xyzu2 = fours(base, places + 2), xyzu3 = fours(base, places + 3);
        const auto xy01 = lower(xyzu0, xyzu1), xy23 = lower(xyzu2, xyzu3);
        const auto zu01 = upper(xyzu0, xyzu1), zu23 = upper(xyzu2, xyzu3);
        x = {whole(firsts(xy01, xy23)), whole(seconds(xy01, xy23)), whole(firsts(zu01, zu23))};
        if constexpr (needsVelocity) {
            const auto vw01 = lower(fours(base + 4, places), fours(base + 4, places + 1));
            const auto vw23 = lower(fours(base + 4, places + 2), fours(base + 4, places + 3));
            v = {seconds(zu01, zu23), firsts(vw01, vw23), seconds(vw01, vw23)};
        }
#endif
    }

    V apart(I mine, I other) const {
        return hn::Mul(unit, hn::ConvertTo(kTag, hn::Sub(mine, other)));
    }

    template <bool needsVelocity>
    Row<float> row(const std::int32_t* others) const {
        Vector3<I> x;
        Vector3<V> v;
        load<needsVelocity>(others, x, v);
        Row<float> row;
        row.isPair = hn::RebindMask(kTag, hn::Ne(hn::LoadU(kWhole, others), self));
        row.separation = {apart(position.x, x.x), apart(position.y, x.y), apart(position.z, x.z)};
        if constexpr (needsVelocity)
            row.velocity = {hn::Sub(velocity.x, v.x), hn::Sub(velocity.y, v.y), hn::Sub(velocity.z, v.z)};
        return row;
    }
};

template <class V>
V dot(const Vector3<V>& a, const Vector3<V>& b) {
    return hn::Add(hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y)), hn::Mul(a.z, b.z));
}

}  // namespace HWY_NAMESPACE
}  // namespace engine
HWY_AFTER_NAMESPACE();

#endif
