// Equation 2 and what follows from it over lanes: as pair_law.h has it, with the same order of products and sums; a
// pair out of reach gives a zero instead of being skipped. Included once per instruction set.
#if defined(ENGINE_SIMD_LAW_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ENGINE_SIMD_LAW_INL_H
#undef ENGINE_SIMD_LAW_INL_H
#else
#define ENGINE_SIMD_LAW_INL_H
#endif

#include <cmath>
#include <limits>
#include <type_traits>

#include "engine/forces/pair_matrix.h"
#include "engine/forces/simd_particles-inl.h"
#include "engine/law/pair_law.h"

HWY_BEFORE_NAMESPACE();
namespace engine {
namespace HWY_NAMESPACE {

/// What a kernel adds up besides forces.
enum class Besides { nothing, energy, energyAndMatrix };

/// What a kernel is compiled for.
template <PairTerms pairTerms, Besides besides>
struct Terms {
    static constexpr PairTerms kPair = pairTerms;
    static constexpr bool kEnergy = besides != Besides::nothing;
    static constexpr bool kMatrix = besides == Besides::energyAndMatrix;
};

/// pairCoefficient(), pairEnergy() and what the matrix holds of a pair, over lanes.
template <class T, class Kind>
struct Law {
    using V = Lanes<T>;
    static constexpr Tag<T> kTag{};
    static constexpr bool kHasUnit = std::is_same_v<T, float>;  // otherwise separations are in meters

    PairConstants<T> c;
    V b1, bd, bdPerUnit, inverseRestSq, inverseReachSq, reachSq, inverseDampingSq, coreSq;
    V unitSq, perUnit, reach, inverseReach, inverseReachCubed, a, b, halfSlope;
    V dampingWeight, stiffnessWeight, friction;

    static V set(T value) { return hn::Set(kTag, value); }

    /// 1/x^2 that no rounded 1/D^2 exceeds at or beyond the rounded x.
    static T inverseOfRounded(double inverseSq) {
        if constexpr (std::is_same_v<T, double>) return inverseSq;
        return T(1) / static_cast<T>(1.0 / inverseSq);
    }

    /// Shape:  unit of the rows' separations, m.
    Law(const PairConstants<double>& exact, const MatrixWeights& weights, double unitLength) {
        c.b1 = static_cast<T>(exact.b1);
        c.bd = static_cast<T>(exact.bd);
        c.inverseRestSq = inverseOfRounded(exact.inverseRestSq);
        c.inverseReachSq = inverseOfRounded(exact.inverseReachSq);
        c.inverseDampingSq = inverseOfRounded(exact.inverseDampingSq);
        c.reachSq = static_cast<T>(exact.reachSq);
        c.coreSq = static_cast<T>(exact.coreSq);
        b1 = set(c.b1);
        bd = set(c.bd);
        bdPerUnit = set(static_cast<T>(exact.bd * unitLength));
        inverseRestSq = set(c.inverseRestSq);
        inverseReachSq = set(c.inverseReachSq);
        reachSq = set(c.reachSq);
        inverseDampingSq = set(c.inverseDampingSq);
        coreSq = set(c.coreSq);
        unitSq = set(static_cast<T>(unitLength * unitLength));
        perUnit = set(static_cast<T>(1.0 / unitLength));
        if constexpr (Kind::kPair.friction) friction = set(static_cast<T>(exact.friction));
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
        if constexpr (Kind::kMatrix) {
            dampingWeight = set(static_cast<T>(weights.damping));
            stiffnessWeight = set(static_cast<T>(weights.stiffness));
        }
    }

    /// D^2, m^2. Shape: P.P in units.
    V squareMeters(V separationSq) const {
        if constexpr (kHasUnit) return hn::Mul(unitSq, separationSq);
        return separationSq;
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

    /// What repulsion and attraction end with.
    V toReach(const Inverse& inverse) const {
        const V end = Kind::kPair.attraction ? inverseReachSq : inverseRestSq;
        return hn::Max(hn::Sub(inverse.square, end), hn::Zero(kTag));
    }

    /// Of the conservative force.
    V conservative(const Inverse& inverse) const {
        const V toRest = hn::Sub(inverse.square, inverseRestSq);
        return hn::Mul(hn::Mul(b1, inverse.root), hn::Mul(toRest, toReach(inverse)));
    }

    /// Of both forces. Shape: V.P in units of separation; of the conservative force.
    V coefficient(const Inverse& inverse, V approach, V conservative) const {
        if constexpr (!Kind::kPair.damping) return conservative;
        const V damping = hn::Mul(bdPerUnit, approach);
        if constexpr (Kind::kPair.oneReach) {
            const V repulsion = hn::Mul(hn::Mul(b1, inverse.root), hn::Sub(inverse.square, inverseRestSq));
            return hn::Mul(hn::Sub(repulsion, damping), toReach(inverse));
        }
        return hn::Sub(conservative, hn::Mul(damping, toDamping(inverse)));
    }

    /// What damping ends with.
    V toDamping(const Inverse& inverse) const {
        return hn::Max(hn::Sub(inverse.square, inverseDampingSq), hn::Zero(kTag));
    }

    /// Friction of pairs: -damping times velocity. Shape: P.P and V.P with P in units.
    struct Slip {
        Vector3<V> velocity;  ///< V_t, m/s
        V damping;            ///< c_t, kg/s
    };

    Slip slipOf(const Row<T>& row, V separationSq, V approach, V conservative) const {
        // A particle is no neighbor of its own, but fills rows up: it shall give a zero and no NaN.
        const V share = hn::Div(approach, hn::Max(separationSq, set(std::numeric_limits<T>::min())));
        const auto across = [&](V velocity, V separation) { return hn::Sub(velocity, hn::Mul(share, separation)); };
        Slip slip;
        slip.velocity = {across(row.velocity.x, row.separation.x), across(row.velocity.y, row.separation.y),
                         across(row.velocity.z, row.separation.z)};
        const V speed = hn::Max(hn::Sqrt(dot(slip.velocity, slip.velocity)), set(static_cast<T>(kStickingSpeed)));
        const V damping =
            hn::Div(hn::Mul(friction, hn::Mul(conservative, hn::Sqrt(squareMeters(separationSq)))), speed);
        slip.damping = hn::IfThenElseZero(hn::Gt(conservative, hn::Zero(kTag)), damping);
        return slip;
    }

    /// What a force is multiplied with to be added to coefficients times P, which is in units.
    V inUnits(V newtons) const {
        if constexpr (kHasUnit) return hn::Mul(perUnit, newtons);
        return newtons;
    }

    V energy(const Inverse& inverse, V distanceSq) const {
        const V guarded = hn::Mul(inverse.guardedSq, inverse.root);
        const V cubes = hn::Mul(hn::Sub(hn::Mul(inverse.square, inverse.root), inverseReachCubed), set(T(1) / T(3)));
        const V middle = hn::Sub(cubes, hn::Mul(a, hn::Sub(inverse.root, inverseReach)));
        const V outside = hn::Mul(b1, hn::Add(middle, hn::Mul(b, hn::Sub(reach, guarded))));
        const V inside = hn::Mul(halfSlope, hn::Sub(inverse.guardedSq, distanceSq));  // 0 beyond the core
        return hn::IfThenElseZero(hn::Lt(distanceSq, reachSq), hn::Add(outside, inside));
    }

    /// (damping b_d s_d + stiffness max(k, 0)) / D^2, with the weights of the matrix. In the core the law softens with
    /// approach, so that k counts as 0.
    V along(const Inverse& inverse, V distanceSq) const {
        const V four = set(T(4));
        const V slope = hn::Mul(inverse.square, hn::Sub(hn::Mul(four, inverse.square), hn::Add(a, a)));
        const V k = hn::Mul(hn::Mul(b1, hn::Mul(inverse.root, inverse.square)), slope);
        const auto isStiff = hn::And(hn::Ge(distanceSq, coreSq), hn::Lt(distanceSq, reachSq));
        V sum = hn::IfThenElseZero(isStiff, hn::Mul(stiffnessWeight, hn::Max(k, hn::Zero(kTag))));
        if constexpr (Kind::kPair.damping) sum = hn::Add(sum, hn::Mul(dampingWeight, hn::Mul(bd, toDamping(inverse))));
        return sum;
    }
};

}  // namespace HWY_NAMESPACE
}  // namespace engine
HWY_AFTER_NAMESPACE();

#endif
