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

    HWY_INLINE const Law<T, variant>& of(const std::int32_t* /*indices*/, None /*others*/) const { return law; }
};

/// The laws of pairs of several materials, of particles of several radii, or both. Which of the two it is costs a
/// branch for every pair, which always goes the same way.
template <class Source, Variant variant>
struct MixedLaws {
    using T = typename Source::T;
    using V = Lanes<T>;
    static constexpr Tag<T> kTag{};
    static constexpr WholeTag<T> kWhole{};
    using Row = PairTableRow<T>;
    using PullRow = PullTableRow<T>;
    /// In single precision, radius and material are loaded with what every pair needs, and a register holds more. Four
    /// rows are the fewest that a table of several laws has.
    static constexpr bool kHasTraits = std::is_same_v<T, float>;
    static constexpr bool kCanLookUp = kHasTraits && hn::MaxLanes(kTag) >= 4;

    const Source& source;
    const PairTableIn<T>& table;
    Law<T, variant> first;  ///< the law in the first row of the table
    bool lawsDiffer, radiiDiffer;
    bool isLookedUp;  ///< whether each field of the table fits a SIMD register
    Traits<T> own;
    Whole<T> firstRows;                            ///< index of the first row of the own particles' materials
    std::array<const Row*, kClusterSize> ownRows;  ///< this row, by lane
    std::array<const PullRow*, kClusterSize> ownPullRows;

    MixedLaws(const PairTraversal& pairs, const MatrixWeights& weights, const Source& from,
              const std::int32_t* ownIndices)
        : source(from), table(pairs.table.in<T>()), first(pairs, weights), own(from.traits(ownIndices)) {
        lawsDiffer = !pairs.terms.oneLaw;
        radiiDiffer = !pairs.terms.oneRadius;
        isLookedUp = kCanLookUp && lawsDiffer && hn::Lanes(kTag) >= table.rows.size();
        using Integer = hn::TFromD<decltype(kWhole)>;
        firstRows = hn::Mul(own.material, hn::Set(kWhole, static_cast<Integer>(pairs.table.materialCount)));
        for (std::size_t lane = 0; lane < hn::Lanes(kTag) && lawsDiffer && !isLookedUp; ++lane) {
            const std::size_t row = source.material(ownIndices[lane]) * pairs.table.materialCount;
            ownRows[lane] = &table.rows[row];
            if constexpr (variant.terms.cohesion) ownPullRows[lane] = &table.pullRows[row];
        }
        first.constants.inverseRestSq = first.set(table.inverseRestSq);
        const auto numbers = [&](const T* at) {
            return Fields<T>{first.set(at[0]), first.set(at[1]), first.set(at[2]), first.set(at[3])};
        };
        setStrengths(numbers(&table.rows.front().b1), first);
        setEnergies(numbers(&table.rows.front().reach), first);
        setRanges(numbers(&table.rows.front().reach), first);
        if constexpr (variant.terms.cohesion) setPull(numbers(&table.pullRows.front().pull), first);
    }

    /// What the law of a pair depends on, of the particles with these indices.
    HWY_INLINE Traits<T> traits(const std::int32_t* indices) const {
        return kHasTraits || radiiDiffer ? source.traits(indices) : own;
    }

    /// The law of the pairs of the own particles and those with these indices and traits.
    HWY_INLINE Law<T, variant> of(const std::int32_t* indices, const Traits<T>& others) const {
        Law<T, variant> law = first;
        if (lawsDiffer) {
            setStrengths(fieldsIn(ownRows, &Row::b1, 0, indices, others), law);
            if constexpr (variant.hasEnergy) setEnergies(fieldsIn(ownRows, &Row::reach, 4, indices, others), law);
            if (table.rangesDiffer) setRanges(fieldsIn(ownRows, &Row::reach, 4, indices, others), law);
            if constexpr (variant.terms.cohesion)
                setPull(fieldsIn(ownPullRows, &PullRow::pull, 8, indices, others), law);
        }
        if (radiiDiffer) {
            const V restLength = hn::Add(own.radius, others.radius);
            PairConstants<V>& c = law.constants;
            c = atRestLength<variant.terms.cohesion>(c, restLength);
            law.reach = hn::Mul(law.reach, restLength);
            // The coefficient falls with the fifth power of the rest length.
            V inverseSq = c.inverseRestSq;
            if constexpr (variant.terms.cohesion) inverseSq = reciprocal(hn::Mul(restLength, restLength));
            law.halfSlope =
                hn::Mul(hn::Mul(law.halfSlope, inverseSq), hn::Mul(inverseSq, hn::Mul(restLength, inverseSq)));
        }
        law.inverseReach = hn::Mul(law.reach, law.constants.inverseReachSq);
        law.inverseReachCubed = hn::Mul(law.inverseReach, law.constants.inverseReachSq);
        law.a = hn::Add(law.constants.inverseRestSq, law.constants.inverseReachSq);
        law.b = hn::Mul(law.constants.inverseRestSq, law.constants.inverseReachSq);
        return law;
    }

 private:
    /// Four fields of the rows of the pairs of the own particles and others.
    /// @param field   the first of the fields
    /// @param column  its number among the columns of the table
    template <class Row>
    HWY_INLINE Fields<T> fieldsIn(const std::array<const Row*, kClusterSize>& rows, T Row::*field, std::size_t column,
                                  const std::int32_t* indices, const Traits<T>& others) const {
        if constexpr (kCanLookUp) {
            if (isLookedUp) {
                const auto at = hn::IndicesFromVec(kTag, hn::Add(firstRows, others.material));
                const auto lookedUp = [&](std::size_t number) HWY_ATTR {
                    return hn::TableLookupLanes(hn::LoadU(kTag, table.columns[number].data()), at);
                };
                return {lookedUp(column), lookedUp(column + 1), lookedUp(column + 2), lookedUp(column + 3)};
            }
        }
        return fieldsAt<T>([&](std::size_t lane)
                               HWY_ATTR { return &(rows[lane][source.material(indices[lane])].*field); });
    }

    // The fields of a row are assigned one by one, as the compiler would copy whole structs through memory.
    HWY_INLINE static void setStrengths(const Fields<T>& fields, Law<T, variant>& law) {
        law.constants.b1 = fields.first;
        law.constants.bd = law.damping = fields.second;
        if constexpr (std::is_same_v<T, float>) law.constants.bd = hn::Mul(law.unit, fields.second);
        law.constants.inverseReachSq = fields.third;
        law.constants.friction = fields.fourth;
        if constexpr (!hasDampingReach(variant.terms)) law.constants.inverseDampingSq = fields.third;
    }

    HWY_INLINE static void setEnergies(const Fields<T>& fields, Law<T, variant>& law) {
        law.reach = fields.first;
        law.constants.reachSq = hn::Mul(law.reach, law.reach);
        law.halfSlope = fields.second;
    }

    HWY_INLINE static void setRanges(const Fields<T>& fields, Law<T, variant>& law) {
        law.constants.coreSq = fields.third;
        if constexpr (hasDampingReach(variant.terms)) law.constants.inverseDampingSq = fields.fourth;
    }

    HWY_INLINE static void setPull(const Fields<T>& fields, Law<T, variant>& law) {
        law.constants.pull = fields.first;
        law.constants.pullReachSq = fields.second;
        law.constants.inversePullWidth = fields.third;
        law.constants.inverseRestSq = fields.fourth;
    }
};

}  // namespace HWY_NAMESPACE
}  // namespace engine
HWY_AFTER_NAMESPACE();

#endif
