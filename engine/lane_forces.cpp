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

/// The particles of a block of lanes in double: positions as they are.
struct Doubles {
    using T = double;
    const double* base;  ///< of the first record
    Places<double> self;
    Vector3<Lanes<double>> position, velocity;

    static constexpr int kStride = sizeof(PairRecord) / sizeof(double);

    Doubles(const LanePass& pass, Places<double> places) : base(&pass.records[0].x), self(places) {
        const auto index = indexOf(places);
        position = {load(index, 0), load(index, 1), load(index, 2)};
        velocity = {load(index, 3), load(index, 4), load(index, 5)};
    }

    static hn::Vec<hn::Rebind<std::int64_t, Tag<double>>> indexOf(Places<double> places) {
        const hn::Rebind<std::int64_t, Tag<double>> wide;
        return hn::Mul(hn::PromoteTo(wide, places), hn::Set(wide, kStride));
    }

    template <class Index>
    Lanes<double> load(Index index, int field) const {
        return hn::GatherIndex(Tag<double>(), base + field, index);
    }

    template <bool needsVelocity>
    Row<double> row(Places<double> others) const {
        const hn::Rebind<std::int64_t, Tag<double>> wide;
        const auto index = indexOf(others);
        Row<double> row;
        row.isPair = hn::RebindMask(Tag<double>(), hn::Ne(hn::PromoteTo(wide, others), hn::PromoteTo(wide, self)));
        row.separation = {hn::Sub(position.x, load(index, 0)), hn::Sub(position.y, load(index, 1)),
                          hn::Sub(position.z, load(index, 2))};
        if constexpr (needsVelocity)
            row.velocity = {hn::Sub(velocity.x, load(index, 3)), hn::Sub(velocity.y, load(index, 4)),
                            hn::Sub(velocity.z, load(index, 5))};
        return row;
    }
};

/// In float: positions are whole numbers of a unit, modulo 2^32, whose differences are exact anywhere in the world.
struct Singles {
    using T = float;
    const std::int32_t* positions;  ///< of the first record
    const float* velocities;        ///< of the first record
    Places<float> self;
    Vector3<Places<float>> position;
    Vector3<Lanes<float>> velocity;
    Lanes<float> unit;

    static constexpr int kStride = sizeof(SinglePrecisionRecord) / sizeof(float);

    Singles(const LanePass& pass, Places<float> places)
        : positions(&pass.singles[0].x), velocities(&pass.singles[0].vx), self(places) {
        const auto index = indexOf(places);
        position = {loadPosition(index, 0), loadPosition(index, 1), loadPosition(index, 2)};
        velocity = {loadVelocity(index, 0), loadVelocity(index, 1), loadVelocity(index, 2)};
        unit = hn::Set(Tag<float>(), static_cast<float>(pass.unit));
    }

    static Places<float> indexOf(Places<float> places) {
        const hn::Rebind<std::int32_t, Tag<float>> tag;
        return hn::Mul(places, hn::Set(tag, kStride));
    }

    Places<float> loadPosition(Places<float> index, int field) const {
        return hn::GatherIndex(hn::Rebind<std::int32_t, Tag<float>>(), positions + field, index);
    }

    Lanes<float> loadVelocity(Places<float> index, int field) const {
        return hn::GatherIndex(Tag<float>(), velocities + field, index);
    }

    Lanes<float> apart(Places<float> mine, Places<float> index, int field) const {
        return hn::Mul(unit, hn::ConvertTo(Tag<float>(), hn::Sub(mine, loadPosition(index, field))));
    }

    template <bool needsVelocity>
    Row<float> row(Places<float> others) const {
        const auto index = indexOf(others);
        Row<float> row;
        row.isPair = hn::RebindMask(Tag<float>(), hn::Ne(others, self));
        row.separation = {apart(position.x, index, 0), apart(position.y, index, 1), apart(position.z, index, 2)};
        if constexpr (needsVelocity)
            row.velocity = {hn::Sub(velocity.x, loadVelocity(index, 0)), hn::Sub(velocity.y, loadVelocity(index, 1)),
                            hn::Sub(velocity.z, loadVelocity(index, 2))};
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
    V core, reach, inverseReach, inverseReachCubed, a, b, slope;

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
            core = set(std::sqrt(c.coreSq));
            reach = set(reachOf);
            inverseReach = set(inverse);
            inverseReachCubed = set(inverse * inverse * inverse);
            a = set(c.inverseRestSq + c.inverseReachSq);
            b = set(c.inverseRestSq * c.inverseReachSq);
            slope = set(pairCoefficient<PairTerms{true, false}>(c.coreSq, T(0), c));
        }
    }

    V coefficient(V distanceSq, V approach) const {
        const V guardedSq = hn::Max(distanceSq, coreSq);
        const V inverseSq = hn::Div(set(T(1)), guardedSq);
        const V toRest = hn::Sub(inverseSq, inverseRestSq);
        V toReach = toRest;
        if constexpr (Kind::kPair.attraction) toReach = hn::Sub(inverseSq, inverseReachSq);
        const V repulsion = hn::Mul(hn::Mul(b1, hn::Sqrt(inverseSq)), hn::Mul(toRest, toReach));
        V sum = hn::IfThenElseZero(hn::Lt(guardedSq, reachSq), repulsion);
        if constexpr (Kind::kPair.damping) {
            const V falling = hn::Sub(set(T(1)), hn::Mul(guardedSq, inverseDampingSq));
            const V damping = hn::Mul(hn::Mul(hn::Mul(bd, falling), inverseSq), approach);
            sum = hn::Sub(sum, hn::IfThenElseZero(hn::Lt(guardedSq, dampingSq), damping));
        }
        return sum;
    }

    V energy(V distanceSq) const {
        const V distance = hn::Sqrt(distanceSq);
        const V distanceSqAgain = hn::Mul(distance, distance);
        const V guarded = hn::Max(distance, core);
        const V inverse = hn::Div(set(T(1)), guarded);
        const V cubed = hn::Mul(hn::Mul(inverse, inverse), inverse);
        const V cubes = hn::Div(hn::Sub(cubed, inverseReachCubed), set(T(3)));
        const V middle = hn::Sub(cubes, hn::Mul(a, hn::Sub(inverse, inverseReach)));
        const V outside = hn::Mul(b1, hn::Add(middle, hn::Mul(b, hn::Sub(reach, guarded))));
        const V inside = hn::Div(hn::Mul(slope, hn::Sub(coreSq, distanceSqAgain)), set(T(2)));
        const V either = hn::Add(outside, hn::IfThenElseZero(hn::Lt(distance, core), inside));
        return hn::IfThenElseZero(hn::Lt(hn::Max(distanceSq, distanceSqAgain), reachSq), either);
    }
};

/// A block of lanes of a group, from one of its lanes on.
template <class Source, class Kind>
void addUpBlock(const LanePass& pass, std::size_t group, std::size_t lane, LaneSums& sums) {
    using T = typename Source::T;
    constexpr Tag<T> kTag{};
    const hn::Rebind<std::int32_t, Tag<T>> places;
    const std::size_t first = group * kGroup + lane;
    std::uint32_t longest = 0;
    for (std::size_t k = 0; k < hn::Lanes(kTag); ++k) longest = std::max(longest, pass.rows.length[first + k]);
    const auto last = hn::Set(places, static_cast<std::int32_t>(pass.records.size() - 1));
    const Source source(pass, hn::Min(hn::Iota(places, static_cast<std::int32_t>(first)), last));
    const Law<T, Kind> law(pass.constants);
    Vector3<Lanes<T>> force{hn::Zero(kTag), hn::Zero(kTag), hn::Zero(kTag)};
    Lanes<T> energy = hn::Zero(kTag);
    auto coincident = hn::FirstN(kTag, 0);
    const std::int32_t* entry = pass.rows.places.data() + pass.rows.start[group] * kGroup + lane;
    for (std::uint32_t k = 0; k < longest; ++k, entry += kGroup) {
        const Row<T> row = source.template row<Kind::kPair.damping>(hn::LoadU(places, entry));
        const Lanes<T> distanceSq = dot(row.separation, row.separation);
        coincident = hn::Or(coincident, hn::And(row.isPair, hn::Eq(distanceSq, hn::Zero(kTag))));
        Lanes<T> approach = hn::Zero(kTag);
        if constexpr (Kind::kPair.damping) approach = dot(row.velocity, row.separation);
        // A place that fills up a row is the particle itself, for which P is zero.
        const Lanes<T> coefficient = law.coefficient(distanceSq, approach);
        force.x = hn::Add(force.x, hn::Mul(coefficient, row.separation.x));
        force.y = hn::Add(force.y, hn::Mul(coefficient, row.separation.y));
        force.z = hn::Add(force.z, hn::Mul(coefficient, row.separation.z));
        if constexpr (Kind::kEnergy)
            energy = hn::Add(
                energy, hn::IfThenElseZero(row.isPair, hn::Mul(Law<T, Kind>::set(T(0.5)), law.energy(distanceSq))));
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
