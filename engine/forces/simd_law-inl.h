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
        const V repulsion = hn::IfThenElseZero(hn::Lt(distanceSq, constants.reachSq), hn::Add(outside, inside));
        if constexpr (variant.terms.cohesion) return hn::Add(repulsion, pullEnergy(distanceSq, constants));
        return repulsion;
    }

    /// (damping b_d s_d + stiffness max(k, 0)) / D^2 with the weights of the matrix. Inside the core distance the force
    /// decreases with approach, so k counts as 0 there.
    V along(V distanceSq, V inverseSq, V inverse) const {
        const V slope = hn::Mul(inverseSq, hn::Sub(hn::Mul(set(T(4)), inverseSq), hn::Add(a, a)));
        const V k = hn::Mul(hn::Mul(constants.b1, hn::Mul(inverse, inverseSq)), slope);
        const auto isStiff = hn::And(hn::Ge(distanceSq, constants.coreSq), hn::Lt(distanceSq, constants.reachSq));
        V sum;
        if constexpr (variant.terms.cohesion) {
            const V v = pullShare(distanceSq, constants);
            const V pulled = hn::IfThenElseZero(hn::Lt(v, set(T(1))), pullStiffness(distanceSq, v, constants));
            const V all = hn::Add(hn::IfThenElseZero(isStiff, k), hn::Mul(inverseSq, pulled));
            sum = hn::Mul(stiffnessWeight, positivePart(all));
        } else {
            sum = hn::IfThenElseZero(isStiff, hn::Mul(stiffnessWeight, positivePart(k)));
        }
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

    OneLaw(const PairTraversal& pairs, const MatrixWeights& weights, const Source& /*source*/,
           const std::int32_t* /*ownIndices*/)
        : law(pairs, weights) {
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
        if constexpr (variant.terms.cohesion) {
            law.constants.pull = law.set(c.pull);
            law.constants.pullReachSq = law.set(c.pullReachSq);
            law.constants.inversePullWidth = law.set(c.inversePullWidth);
        }
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

    /// What the law of a pair depends on, of the particles with these indices: nothing.
    struct None {};
    HWY_INLINE None traits(const std::int32_t* /*indices*/) const { return {}; }

    /// The law of the pairs of the own particles and others with these traits.
    HWY_INLINE const Law<T, variant>& of(None /*others*/) const { return law; }
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
    static constexpr WholeTag<T> kWhole{};

    const Source& source;
    const PairTableIn<T>& table;
    Law<T, variant> common;  ///< what all pairs have in common; of the constants only 1/D0^2, where there is one radius
    bool hasLaws, hasRadii;
    bool isSmall;        ///< whether each field of the table fits a SIMD register
    Whole<T> firstRows;  ///< first row in the table of the own particles' materials
    V ownRadius;

    MixedLaws(const PairTraversal& pairs, const MatrixWeights& weights, const Source& from,
              const std::int32_t* ownIndices)
        : source(from), table(pairs.table.in<T>()), common(pairs, weights) {
        hasLaws = !pairs.terms.oneLaw;
        hasRadii = !pairs.terms.oneRadius;
        isSmall = table.rows.size() <= hn::Lanes(kTag);
        common.constants.inverseRestSq = common.set(table.inverseRestSq);
        const Traits<T> own = source.traits(ownIndices);
        ownRadius = own.radius;
        using Integer = hn::TFromD<decltype(kWhole)>;
        firstRows = hn::Mul(own.material, hn::Set(kWhole, static_cast<Integer>(pairs.table.materialCount)));
    }

    HWY_INLINE Traits<T> traits(const std::int32_t* indices) const { return source.traits(indices); }

    /// The law of the pairs of the own particles and others with these traits.
    HWY_INLINE Law<T, variant> of(const Traits<T>& others) const {
        LaneRow<V> row;
        readRow(others, row);
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
        if constexpr (variant.terms.cohesion) readPull(others, c);
        if (hasRadii) {
            const V restLength = hn::Add(ownRadius, others.radius);
            c = atRestLength<variant.terms.cohesion>(c, restLength);
            law.reach = hn::Mul(row.reach, restLength);
            // The coefficient falls with the fifth power of the rest length.
            V inverseSq = c.inverseRestSq;
            if constexpr (variant.terms.cohesion) inverseSq = reciprocal(hn::Mul(restLength, restLength));
            law.halfSlope =
                hn::Mul(hn::Mul(row.halfSlope, inverseSq), hn::Mul(inverseSq, hn::Mul(restLength, inverseSq)));
        }
        law.inverseReach = hn::Mul(law.reach, c.inverseReachSq);
        law.inverseReachCubed = hn::Mul(law.inverseReach, c.inverseReachSq);
        law.a = hn::Add(c.inverseRestSq, c.inverseReachSq);
        law.b = hn::Mul(c.inverseRestSq, c.inverseReachSq);
        return law;
    }

 private:
    /// Reads the rows of the table for the pairs of the own particles and these. The fields are assigned one by one, as
    /// the compiler would copy whole structs through memory.
    HWY_INLINE void readRow(const Traits<T>& others, LaneRow<V>& row) const {
        if (!hasLaws) return assign(row, [&](std::size_t field) { return common.set(table.columns[field][0]); });
        const Whole<T> rows = hn::Add(firstRows, others.material);
        if constexpr (hn::MaxLanes(kTag) >= 4) {  // the fewest rows that a table of several laws has
            if (isSmall) {
                const auto at = hn::IndicesFromVec(kTag, rows);
                return assign(row, [&](std::size_t field) {
                    return hn::TableLookupLanes(hn::LoadU(kTag, table.columns[field].data()), at);
                });
            }
        }
        std::array<hn::TFromD<WholeTag<T>>, kClusterSize> indices;
        hn::StoreU(rows, kWhole, indices.data());
        constexpr std::int64_t kStride = sizeof(PairTableRow<T>) / sizeof(T);
        const Fields<T> near = fieldsOf(&table.rows.front().b1, kStride, indices.data());
        row.b1 = near.first;
        row.bd = near.second;
        row.coreSq = near.third;
        row.outerInverseSq = near.fourth;
        const Fields<T> far = fieldsOf(&table.rows.front().inverseReachSq, kStride, indices.data());
        row.inverseReachSq = far.first;
        row.friction = far.second;
        row.reach = far.third;
        row.halfSlope = far.fourth;
    }

    /// Reads the constants of the pull and the rest length of the pairs of the own particles and these.
    HWY_INLINE void readPull(const Traits<T>& others, PairConstants<V>& c) const {
        const auto assignPull = [&](const auto& value) {
            c.pull = value(0);
            c.pullReachSq = value(1);
            c.inversePullWidth = value(2);
            c.inverseRestSq = value(3);
        };
        if (!hasLaws) return assignPull([&](std::size_t field) { return common.set(table.pullColumns[field][0]); });
        const Whole<T> rows = hn::Add(firstRows, others.material);
        if constexpr (hn::MaxLanes(kTag) >= 4) {
            if (isSmall) {
                const auto at = hn::IndicesFromVec(kTag, rows);
                return assignPull([&](std::size_t field) {
                    return hn::TableLookupLanes(hn::LoadU(kTag, table.pullColumns[field].data()), at);
                });
            }
        }
        std::array<hn::TFromD<WholeTag<T>>, kClusterSize> indices;
        hn::StoreU(rows, kWhole, indices.data());
        constexpr std::int64_t kStride = sizeof(PullTableRow<T>) / sizeof(T);
        const Fields<T> fields = fieldsOf(&table.pullRows.front().pull, kStride, indices.data());
        c.pull = fields.first;
        c.pullReachSq = fields.second;
        c.inversePullWidth = fields.third;
        c.inverseRestSq = fields.fourth;
    }

    /// Assigns value(number of the field) to the fields of a row.
    template <class Value>
    HWY_INLINE static void assign(LaneRow<V>& row, const Value& value) {
        row.b1 = value(0);
        row.bd = value(1);
        row.coreSq = value(2);
        row.outerInverseSq = value(3);
        row.inverseReachSq = value(4);
        row.friction = value(5);
        row.reach = value(6);
        row.halfSlope = value(7);
    }
};

}  // namespace HWY_NAMESPACE
}  // namespace engine
HWY_AFTER_NAMESPACE();

#endif
