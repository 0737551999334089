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

/// The particles of a block of lanes in double: positions as they are. Records are read a lane each; where vectors have
/// 32 bytes, loads and shuffles do what gathers take longer for.
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
#if HWY_TARGET == HWY_AVX2
        const auto record = [&](int lane) { return base + kStride * places[lane]; };
        const auto half = [&](int lane) { return hn::Load(kTag, record(lane)); };
        const auto evenLow = hn::InterleaveLower(kTag, half(0), half(1));
        const auto oddLow = hn::InterleaveUpper(kTag, half(0), half(1));
        const auto evenHigh = hn::InterleaveLower(kTag, half(2), half(3));
        const auto oddHigh = hn::InterleaveUpper(kTag, half(2), half(3));
        x = {hn::ConcatLowerLower(kTag, evenHigh, evenLow), hn::ConcatLowerLower(kTag, oddHigh, oddLow),
             hn::ConcatUpperUpper(kTag, evenHigh, evenLow)};
        if constexpr (needsVelocity) {
            const auto rest = [&](int lane) { return hn::Load(kTag, record(lane) + 4); };
            v.x = hn::ConcatUpperUpper(kTag, oddHigh, oddLow);
            v.y = hn::ConcatLowerLower(kTag, hn::InterleaveLower(kTag, rest(2), rest(3)),
                                       hn::InterleaveLower(kTag, rest(0), rest(1)));
            v.z = hn::ConcatLowerLower(kTag, hn::InterleaveUpper(kTag, rest(2), rest(3)),
                                       hn::InterleaveUpper(kTag, rest(0), rest(1)));
        }
#else
        const hn::Rebind<std::int64_t, Tag<double>> wide;
        const hn::Rebind<std::int32_t, Tag<double>> narrow;
        const auto index = hn::Mul(hn::PromoteTo(wide, hn::LoadU(narrow, places)), hn::Set(wide, kStride));
        const auto gather = [&](int field) { return hn::GatherIndex(kTag, base + field, index); };
        x = {gather(0), gather(1), gather(2)};
        if constexpr (needsVelocity) v = {gather(3), gather(4), gather(5)};
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
    static constexpr std::int32_t kStride = sizeof(SinglePrecisionRecord) / sizeof(float);

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
        const auto whole = [&](V bits) { return hn::BitCast(kWhole, bits); };
#if HWY_TARGET == HWY_AVX2
        const hn::Repartition<double, Tag<float>> pairs;
        const auto record = [&](int lane) {
            return hn::Load(kTag, base + static_cast<std::ptrdiff_t>(kStride) * places[lane]);
        };
        const auto lower = [&](int lane) {
            return hn::BitCast(pairs, hn::InterleaveLower(kTag, record(lane), record(lane + 1)));
        };
        const auto upper = [&](int lane) {
            return hn::BitCast(pairs, hn::InterleaveUpper(kTag, record(lane), record(lane + 1)));
        };
        const auto float8 = [&](auto vector) { return hn::BitCast(kTag, vector); };
        // The first four lanes' and the last four's, each with x or y or z or v_x below and v_y or v_z above.
        const auto first0 = float8(hn::InterleaveLower(pairs, lower(0), lower(2)));
        const auto first1 = float8(hn::InterleaveUpper(pairs, lower(0), lower(2)));
        const auto first2 = float8(hn::InterleaveLower(pairs, upper(0), upper(2)));
        const auto last0 = float8(hn::InterleaveLower(pairs, lower(4), lower(6)));
        const auto last1 = float8(hn::InterleaveUpper(pairs, lower(4), lower(6)));
        const auto last2 = float8(hn::InterleaveLower(pairs, upper(4), upper(6)));
        x = {whole(hn::ConcatLowerLower(kTag, last0, first0)), whole(hn::ConcatLowerLower(kTag, last1, first1)),
             whole(hn::ConcatLowerLower(kTag, last2, first2))};
        if constexpr (needsVelocity) {
            const auto first3 = float8(hn::InterleaveUpper(pairs, upper(0), upper(2)));
            const auto last3 = float8(hn::InterleaveUpper(pairs, upper(4), upper(6)));
            v = {hn::ConcatLowerLower(kTag, last3, first3), hn::ConcatUpperUpper(kTag, last0, first0),
                 hn::ConcatUpperUpper(kTag, last1, first1)};
        }
#else
        const auto index = hn::Mul(hn::LoadU(kWhole, places), hn::Set(kWhole, kStride));
        const auto gather = [&](int field) { return hn::GatherIndex(kTag, base + field, index); };
        x = {whole(gather(0)), whole(gather(1)), whole(gather(2))};
        if constexpr (needsVelocity) v = {gather(3), gather(4), gather(5)};
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
