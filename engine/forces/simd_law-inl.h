// The constants of the force law for the pairs in the SIMD lanes, which are the same for all pairs or looked up for
// each. Energies and matrix entries are computed here from quantities that the force needs anyway. Highway includes
// this file once per instruction set, hence the unusual include guard below.
#if defined(ENGINE_SIMD_LAW_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ENGINE_SIMD_LAW_INL_H
#undef ENGINE_SIMD_LAW_INL_H
#else
#define ENGINE_SIMD_LAW_INL_H
#endif

#include <cmath>
#include <type_traits>

#include "engine/forces/pair_sums.h"
#include "engine/forces/simd_particles-inl.h"

HWY_BEFORE_NAMESPACE();
namespace engine {
namespace HWY_NAMESPACE {

// The formulas of the force law, compiled for this instruction set.
#include "engine/force_law/pair_force-inl.h"

/// The force law of the pair in each SIMD lane. Separations P are in units of PairTraversal::unit, in meters for
/// double.
template <class T, Variant variant>
struct Law {
    using V = Lanes<T>;
    static constexpr Tag<T> kTag{};
    static constexpr bool kHasUnit = std::is_same_v<T, float>;

    PairConstants<V> constants;  ///< bd is multiplied by the unit of P
    V unit, unitSq, perUnit;
    V reach, inverseReach, inverseReachCubed, a, b, halfSlope;  ///< constants of the pair energy
    V damping, dampingWeight, stiffnessWeight;                  ///< constants of matrix entries

    static V set(T value) { return hn::Set(kTag, value); }
    static V set64(double value) { return set(static_cast<T>(value)); }

    /// A law whose constants are not known yet.
    Law(const PairTraversal& pairs, const MatrixWeights& weights) {
        unit = set64(pairs.unit);
        unitSq = set64(pairs.unit * pairs.unit);
        perUnit = set64(1.0 / pairs.unit);
        dampingWeight = set64(weights.damping);
        stiffnessWeight = set64(weights.stiffness);
    }

    /// D^2 in m^2 from P.P in units.
    V squareMeters(V separationSq) const {
        if constexpr (kHasUnit) return hn::Mul(unitSq, separationSq);
        return separationSq;
    }

    /// Converts a force from newtons to the unit of a coefficient (N/m) times P in units.
    V perUnitOf(V newtons) const {
        if constexpr (kHasUnit) return hn::Mul(perUnit, newtons);
        return newtons;
    }

    /// Pair energy as in pairEnergy() of force_law/pair_law.h, with the distance D computed as guardedSq * inverse
    /// instead of by a square root.
    V energy(V distanceSq, V inverseSq, V inverse) const {
        const V guardedSq = larger(distanceSq, constants.coreSq);
        const V guarded = hn::Mul(guardedSq, inverse);
        const V cubes = hn::Mul(hn::Sub(hn::Mul(inverseSq, inverse), inverseReachCubed), set(T(1) / T(3)));
        const V middle = hn::Sub(cubes, hn::Mul(a, hn::Sub(inverse, inverseReach)));
        const V outside = hn::Mul(constants.b1, hn::Add(middle, hn::Mul(b, hn::Sub(reach, guarded))));
        const V inside = hn::Mul(halfSlope, hn::Sub(guardedSq, distanceSq));  // 0 beyond the core distance
        return hn::IfThenElseZero(hn::Lt(distanceSq, constants.reachSq), hn::Add(outside, inside));
    }

    /// (damping b_d s_d + stiffness max(k, 0)) / D^2 with the weights of the matrix. Inside the core distance the force
    /// decreases with approach, so k counts as 0 there.
    V along(V distanceSq, V inverseSq, V inverse) const {
        const V slope = hn::Mul(inverseSq, hn::Sub(hn::Mul(set(T(4)), inverseSq), hn::Add(a, a)));
        const V k = hn::Mul(hn::Mul(constants.b1, hn::Mul(inverse, inverseSq)), slope);
        const auto isStiff = hn::And(hn::Ge(distanceSq, constants.coreSq), hn::Lt(distanceSq, constants.reachSq));
        V sum = hn::IfThenElseZero(isStiff, hn::Mul(stiffnessWeight, positivePart(k)));
        if constexpr (variant.terms.damping) {
            const V toDamping = positivePart(hn::Sub(inverseSq, constants.inverseDampingSq));
            sum = hn::Add(sum, hn::Mul(dampingWeight, hn::Mul(damping, toDamping)));
        }
        return sum;
    }
};

/// One law for all pairs.
template <class Source, Variant variant>
struct OneLaw {
    using T = typename Source::T;
    Law<T, variant> law;

    OneLaw(const PairTraversal& pairs, const MatrixWeights& weights, const Source& /*own*/) : law(pairs, weights) {
        const engine::PairConstants<double>& exact = pairs.table.constants.front();
        const engine::PairConstants<T> c = roundedConstants<T>(exact);
        law.constants.b1 = law.set(c.b1);
        law.constants.bd = law.set64(exact.bd * pairs.unit);
        law.constants.inverseRestSq = law.set(c.inverseRestSq);
        law.constants.inverseReachSq = law.set(c.inverseReachSq);
        law.constants.reachSq = law.set(c.reachSq);
        law.constants.inverseDampingSq = law.set(c.inverseDampingSq);
        law.constants.coreSq = law.set(c.coreSq);
        law.constants.friction = law.set(c.friction);
        if constexpr (variant.hasEnergy) {
            const T reach = std::sqrt(c.reachSq);
            const T inverse = T(1) / reach;
            law.reach = law.set(reach);
            law.inverseReach = law.set(inverse);
            law.inverseReachCubed = law.set(inverse * inverse * inverse);
            law.a = law.set(c.inverseRestSq + c.inverseReachSq);
            law.b = law.set(c.inverseRestSq * c.inverseReachSq);
            law.halfSlope = law.set(T(0.5) * engine::pairCoefficient<kConservative>(c.coreSq, T(0), c));
        }
        if constexpr (variant.hasMatrix) law.damping = law.set(c.bd);
    }

    /// The law of the pairs of the own particles and the neighbors `others`, which were loaded for these indices.
    template <class Loaded>
    HWY_INLINE const Law<T, variant>& of(const std::int32_t* /*indices*/, const Loaded& /*others*/) const {
        return law;
    }
};

/// A row of the table of materials for the pair in each SIMD lane; the fields are those of PairTableRow.
template <class V>
struct LaneRow {
    V b1, bd, coreSq, outerInverseSq, inverseReachSq, friction, reach, halfSlope;
};

/// The laws of pairs of several materials, of particles of several radii, or both. Which of the two it is costs a
/// branch for every pair, which always goes the same way.
template <class Source, Variant variant>
struct MixedLaws {
    using T = typename Source::T;
    using V = Lanes<T>;
    static constexpr Tag<T> kTag{};

    const Source& source;
    Law<T, variant> common;  ///< what all pairs have in common; of the constants only 1/D0^2, where there is one radius
    bool hasLaws, hasRadii;
    const PairTableRow<T>* table;
    LaneRow<V> front;                                 ///< the first row, for one law
    std::array<std::int32_t, kClusterSize> firstRow;  ///< number of the first row of each own particle's material

    MixedLaws(const PairTraversal& pairs, const MatrixWeights& weights, const Source& own)
        : source(own), common(pairs, weights), hasLaws(!pairs.terms.oneLaw), hasRadii(!pairs.terms.oneRadius) {
        if constexpr (std::is_same_v<T, double>)
            table = pairs.table.doubles.data();
        else
            table = pairs.table.singles.data();
        const auto set = [](T value) { return hn::Set(kTag, value); };
        common.constants.inverseRestSq = set(roundedConstants<T>(pairs.table.constants.front()).inverseRestSq);
        front = {set(table->b1),
                 set(table->bd),
                 set(table->coreSq),
                 set(table->outerInverseSq),
                 set(table->inverseReachSq),
                 set(table->friction),
                 set(table->reach),
                 set(table->halfSlope)};
        for (std::size_t lane = 0; lane < hn::Lanes(kTag); ++lane)
            firstRow[lane] = static_cast<std::int32_t>(own.ownMaterial(lane) * pairs.table.materialCount);
    }

    /// The law of the pairs of the own particles and the neighbors `others`, which were loaded for these indices.
    template <class Loaded>
    HWY_INLINE Law<T, variant> of(const std::int32_t* indices, const Loaded& others) const {
        LaneRow<V> row = front;
        if (hasLaws) row = rowOf(indices);
        Law<T, variant> law = common;
        PairConstants<V>& c = law.constants;
        c.b1 = row.b1;
        c.coreSq = row.coreSq;
        c.inverseDampingSq = row.outerInverseSq;
        c.inverseReachSq = hasDampingReach(variant.terms) ? row.inverseReachSq : row.outerInverseSq;
        c.friction = row.friction;
        c.bd = law.damping = row.bd;
        if constexpr (law.kHasUnit) c.bd = hn::Mul(common.unit, row.bd);
        law.reach = row.reach;
        law.halfSlope = row.halfSlope;
        c.reachSq = hn::Mul(row.reach, row.reach);
        if (hasRadii) {
            const V restLength = hn::Add(source.own.radius, others.radius);
            c = atRestLength(c, restLength);
            law.reach = hn::Mul(row.reach, restLength);
            // The coefficient falls with the fifth power of the rest length.
            law.halfSlope = hn::Mul(hn::Mul(row.halfSlope, c.inverseRestSq),
                                    hn::Mul(c.inverseRestSq, hn::Mul(restLength, c.inverseRestSq)));
        }
        law.inverseReach = hn::Mul(law.reach, c.inverseReachSq);
        law.inverseReachCubed = hn::Mul(law.inverseReach, c.inverseReachSq);
        law.a = hn::Add(c.inverseRestSq, c.inverseReachSq);
        law.b = hn::Mul(c.inverseRestSq, c.inverseReachSq);
        return law;
    }

 private:
    /// The rows of the table for the pairs of the own particles and the neighbors with these indices.
    HWY_INLINE LaneRow<V> rowOf(const std::int32_t* indices) const {
        std::array<std::int32_t, kClusterSize> rows;
        for (std::size_t lane = 0; lane < hn::Lanes(kTag); ++lane)
            rows[lane] = firstRow[lane] + static_cast<std::int32_t>(source.packed[indices[lane]].material);
        constexpr std::int64_t kStride = sizeof(PairTableRow<T>) / sizeof(T);
        const Fields<T> near = fieldsOf(&table->b1, kStride, rows.data());
        const Fields<T> far = fieldsOf(&table->inverseReachSq, kStride, rows.data());
        return {near.first, near.second, near.third, near.fourth, far.first, far.second, far.third, far.fourth};
    }
};

}  // namespace HWY_NAMESPACE
}  // namespace engine
HWY_AFTER_NAMESPACE();

#endif
