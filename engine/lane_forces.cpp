// The kernel, compiled once per instruction set. Sums and products stand as in pair_law.h; a pair out of reach adds a
// zero instead of being skipped.
#include "engine/lane_forces.h"

#include <cmath>

// Vectors are kept in structs here, which sizeless SVE and RVV types do not allow.
#define HWY_DISABLED_TARGETS (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/lane_forces.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

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

template <PairTerms pairTerms, bool hasEnergy>
struct Terms {
    static constexpr PairTerms kPair = pairTerms;
    static constexpr bool kEnergy = hasEnergy;
};

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

    Doubles(const LanePass& pass, const std::int32_t* places)
        : base(&pass.records[0].x), self(hn::LoadU(hn::Rebind<std::int32_t, Tag<double>>(), places)) {
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

    Singles(const LanePass& pass, const std::int32_t* places)
        : base(reinterpret_cast<const float*>(pass.singles.data())), self(hn::LoadU(kWhole, places)) {
        load<true>(places, position, velocity);
        unit = hn::Set(kTag, static_cast<float>(pass.unit));
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

/// pairCoefficient() and pairEnergy() over lanes.
template <class T, class Kind>
struct Law {
    using V = Lanes<T>;
    static constexpr Tag<T> kTag{};

    PairConstants<T> c;
    V b1, bd, inverseRestSq, inverseReachSq, reachSq, inverseDampingSq, dampingSq, coreSq;
    V reach, inverseReach, inverseReachCubed, a, b, halfSlope;

    static V set(T value) { return hn::Set(kTag, value); }

    explicit Law(const PairConstants<double>& wide) {
        c.b1 = static_cast<T>(wide.b1);
        c.bd = static_cast<T>(wide.bd);
        c.inverseRestSq = static_cast<T>(wide.inverseRestSq);
        c.inverseReachSq = static_cast<T>(wide.inverseReachSq);
        c.reachSq = static_cast<T>(wide.reachSq);
        c.inverseDampingSq = static_cast<T>(wide.inverseDampingSq);
        c.dampingSq = static_cast<T>(wide.dampingSq);
        c.coreSq = static_cast<T>(wide.coreSq);
        b1 = set(c.b1);
        bd = set(c.bd);
        inverseRestSq = set(c.inverseRestSq);
        inverseReachSq = set(c.inverseReachSq);
        reachSq = set(c.reachSq);
        inverseDampingSq = set(c.inverseDampingSq);
        dampingSq = set(c.dampingSq);
        coreSq = set(c.coreSq);
        if constexpr (Kind::kEnergy) {
            const T reachOf = std::sqrt(c.reachSq);
            const T inverse = T(1) / reachOf;
            reach = set(reachOf);
            inverseReach = set(inverse);
            inverseReachCubed = set(inverse * inverse * inverse);
            a = set(c.inverseRestSq + c.inverseReachSq);
            b = set(c.inverseRestSq * c.inverseReachSq);
            halfSlope = set(T(0.5) * pairCoefficient<PairTerms{true, false}>(c.coreSq, T(0), c));
        }
    }

    /// What force and energy of a pair share.
    struct Inverse {
        V guardedSq, square, root;  ///< of the distance; 1 over it; 1 over the distance
    };

    Inverse inverseOf(V distanceSq) const {
        const V guardedSq = hn::Max(distanceSq, coreSq);
        const V square = hn::Div(set(T(1)), guardedSq);
        return {guardedSq, square, hn::Sqrt(square)};
    }

    V coefficient(const Inverse& inverse, V approach) const {
        const V toRest = hn::Sub(inverse.square, inverseRestSq);
        V toReach = toRest;
        if constexpr (Kind::kPair.attraction) toReach = hn::Sub(inverse.square, inverseReachSq);
        const V repulsion = hn::Mul(hn::Mul(b1, inverse.root), hn::Mul(toRest, toReach));
        V sum = hn::IfThenElseZero(hn::Lt(inverse.guardedSq, reachSq), repulsion);
        if constexpr (Kind::kPair.damping) {
            const V falling = hn::Sub(set(T(1)), hn::Mul(inverse.guardedSq, inverseDampingSq));
            const V damping = hn::Mul(hn::Mul(hn::Mul(bd, falling), inverse.square), approach);
            sum = hn::Sub(sum, hn::IfThenElseZero(hn::Lt(inverse.guardedSq, dampingSq), damping));
        }
        return sum;
    }

    V energy(const Inverse& inverse, V distanceSq) const {
        const V guarded = hn::Mul(inverse.guardedSq, inverse.root);
        const V cubes = hn::Mul(hn::Sub(hn::Mul(inverse.square, inverse.root), inverseReachCubed), set(T(1) / T(3)));
        const V middle = hn::Sub(cubes, hn::Mul(a, hn::Sub(inverse.root, inverseReach)));
        const V outside = hn::Mul(b1, hn::Add(middle, hn::Mul(b, hn::Sub(reach, guarded))));
        const V inside = hn::Mul(halfSlope, hn::Sub(inverse.guardedSq, distanceSq));  // 0 beyond the core
        return hn::IfThenElseZero(hn::Lt(distanceSq, reachSq), hn::Add(outside, inside));
    }
};

/// A block of lanes of a group, from one of its lanes on.
template <class Source, class Kind>
void addUpBlock(const LanePass& pass, std::size_t group, std::size_t lane, LaneSums& sums) {
    using T = typename Source::T;
    constexpr Tag<T> kTag{};
    const std::size_t first = group * kGroup + lane;
    std::uint32_t longest = 0;
    for (std::size_t k = 0; k < hn::Lanes(kTag); ++k) longest = std::max(longest, pass.rows.length[first + k]);
    std::array<std::int32_t, kGroup> selves;
    for (std::size_t k = 0; k < hn::Lanes(kTag); ++k)
        selves[k] = static_cast<std::int32_t>(std::min(first + k, pass.records.size() - 1));
    const Source source(pass, selves.data());
    const Law<T, Kind> law(pass.constants);
    Vector3<Lanes<T>> force{hn::Zero(kTag), hn::Zero(kTag), hn::Zero(kTag)};
    Lanes<T> energy = hn::Zero(kTag);
    auto coincident = hn::FirstN(kTag, 0);
    const std::int32_t* entry = pass.rows.places.data() + pass.rows.start[group] * kGroup + lane;
    for (std::uint32_t k = 0; k < longest; ++k, entry += kGroup) {
        const Row<T> row = source.template row<Kind::kPair.damping>(entry);
        const Lanes<T> distanceSq = dot(row.separation, row.separation);
        coincident = hn::Or(coincident, hn::And(row.isPair, hn::Eq(distanceSq, hn::Zero(kTag))));
        Lanes<T> approach = hn::Zero(kTag);
        if constexpr (Kind::kPair.damping) approach = dot(row.velocity, row.separation);
        // A place that fills up a row is the particle itself, for which P is zero.
        const auto inverse = law.inverseOf(distanceSq);
        const Lanes<T> coefficient = law.coefficient(inverse, approach);
        force.x = hn::Add(force.x, hn::Mul(coefficient, row.separation.x));
        force.y = hn::Add(force.y, hn::Mul(coefficient, row.separation.y));
        force.z = hn::Add(force.z, hn::Mul(coefficient, row.separation.z));
        if constexpr (Kind::kEnergy)
            energy = hn::Add(energy, hn::IfThenElseZero(row.isPair, hn::Mul(Law<T, Kind>::set(T(0.5)),
                                                                            law.energy(inverse, distanceSq))));
    }
    std::array<T, kGroup> x, y, z, e;
    hn::StoreU(force.x, kTag, x.data());
    hn::StoreU(force.y, kTag, y.data());
    hn::StoreU(force.z, kTag, z.data());
    hn::StoreU(energy, kTag, e.data());
    for (std::size_t k = 0; k < hn::Lanes(kTag); ++k) {
        sums.x[lane + k] = static_cast<double>(x[k]);
        sums.y[lane + k] = static_cast<double>(y[k]);
        sums.z[lane + k] = static_cast<double>(z[k]);
        sums.energy[lane + k] = static_cast<double>(e[k]);
    }
    sums.coincident = sums.coincident || !hn::AllFalse(kTag, coincident);
}

template <class Source, class Kind>
void addUpLanes(const LanePass& pass, std::size_t group, LaneSums& sums) {
    const std::size_t step = hn::Lanes(Tag<typename Source::T>());
    for (std::size_t lane = 0; lane < kGroup; lane += step) addUpBlock<Source, Kind>(pass, group, lane, sums);
}

template <class Source, PairTerms terms>
void addUpWith(const LanePass& pass, std::size_t group, LaneSums& sums) {
    if (pass.energy)
        addUpLanes<Source, Terms<terms, true>>(pass, group, sums);
    else
        addUpLanes<Source, Terms<terms, false>>(pass, group, sums);
}

template <class Source>
void addUpFrom(const LanePass& pass, std::size_t group, LaneSums& sums) {
    if (pass.terms.attraction)
        pass.terms.damping ? addUpWith<Source, PairTerms{true, true}>(pass, group, sums)
                           : addUpWith<Source, PairTerms{true, false}>(pass, group, sums);
    else
        pass.terms.damping ? addUpWith<Source, PairTerms{false, true}>(pass, group, sums)
                           : addUpWith<Source, PairTerms{false, false}>(pass, group, sums);
}

void addUpGroupHere(const LanePass& pass, std::size_t group, LaneSums& sums) {
    sums.coincident = false;
    if (pass.singles.empty())
        addUpFrom<Doubles>(pass, group, sums);
    else
        addUpFrom<Singles>(pass, group, sums);
}

const char* instructionSetHere() {
    return hwy::TargetName(HWY_TARGET);
}

}  // namespace HWY_NAMESPACE
}  // namespace engine
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace engine {

HWY_EXPORT(addUpGroupHere);
HWY_EXPORT(instructionSetHere);

void addUpGroup(const LanePass& pass, std::size_t group, LaneSums& sums) {
    HWY_DYNAMIC_DISPATCH(addUpGroupHere)(pass, group, sums);
}

const char* laneInstructionSet() {
    return HWY_DYNAMIC_DISPATCH(instructionSetHere)();
}

}  // namespace engine

#endif
