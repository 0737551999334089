// SIMD kernels that sum over the neighbors of a cluster of particles, compiled once per instruction set. The force law
// comes from force_law/pair_force-inl.h. Energies and matrix entries are computed here from quantities that the force
// needs anyway. A neighbor beyond the cutoff is not skipped but adds zeros.
#include "engine/forces/simd_forces.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/forces/simd_forces.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "engine/forces/simd_particles-inl.h"

HWY_BEFORE_NAMESPACE();
namespace engine {
namespace HWY_NAMESPACE {

// The formulas of the force law, compiled for this instruction set.
#include "engine/force_law/pair_force-inl.h"

/// The number 1/x^2 rounded to T in such a way that for every distance D at or beyond the rounded x the rounded 1/D^2
/// does not exceed it.
template <class T>
T roundedInverse(double inverseSq) {
    if constexpr (std::is_same_v<T, double>) return inverseSq;
    return T(1) / static_cast<T>(1.0 / inverseSq);
}

/// The constants of the force law, broadcast to every SIMD lane. Separations P are in units of PairTraversal::unit, in
/// meters for double.
template <class T, Variant variant>
struct Law {
    using V = Lanes<T>;
    static constexpr Tag<T> kTag{};
    static constexpr bool kHasUnit = std::is_same_v<T, float>;

    PairConstants<V> constants;  ///< constants of every pair; bd is multiplied by the unit of P
    V unitSq, perUnit;
    V reach, inverseReach, inverseReachCubed, a, b, halfSlope;  ///< constants of the pair energy
    V damping, dampingWeight, stiffnessWeight;                  ///< constants of matrix entries

    static V set(T value) { return hn::Set(kTag, value); }
    static V set64(double value) { return set(static_cast<T>(value)); }

    Law(const PairTraversal& pairs, const MatrixWeights& weights) {
        const engine::PairConstants<double>& exact = pairs.uniform;
        engine::PairConstants<T> c{};
        c.b1 = static_cast<T>(exact.b1);
        c.inverseRestSq = roundedInverse<T>(exact.inverseRestSq);
        c.inverseReachSq = roundedInverse<T>(exact.inverseReachSq);
        c.inverseDampingSq = roundedInverse<T>(exact.inverseDampingSq);
        c.reachSq = static_cast<T>(exact.reachSq);
        c.coreSq = static_cast<T>(exact.coreSq);
        constants.b1 = set(c.b1);
        constants.bd = set64(exact.bd * pairs.unit);
        constants.inverseRestSq = set(c.inverseRestSq);
        constants.inverseReachSq = set(c.inverseReachSq);
        constants.reachSq = set(c.reachSq);
        constants.inverseDampingSq = set(c.inverseDampingSq);
        constants.coreSq = set(c.coreSq);
        constants.friction = set64(exact.friction);
        unitSq = set64(pairs.unit * pairs.unit);
        perUnit = set64(1.0 / pairs.unit);
        if constexpr (variant.hasEnergy) {
            const T reachLength = std::sqrt(c.reachSq);
            const T inverse = T(1) / reachLength;
            reach = set(reachLength);
            inverseReach = set(inverse);
            inverseReachCubed = set(inverse * inverse * inverse);
            a = set(c.inverseRestSq + c.inverseReachSq);
            b = set(c.inverseRestSq * c.inverseReachSq);
            halfSlope = set(T(0.5) * engine::pairCoefficient<kConservative>(c.coreSq, T(0), c));
        }
        if constexpr (variant.hasMatrix) {
            damping = set64(exact.bd);
            dampingWeight = set64(weights.damping);
            stiffnessWeight = set64(weights.stiffness);
        }
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

/// Friction of the pairs in the SIMD lanes: the friction force is -damping times the slip velocity.
template <class V>
struct Slip {
    Vector3<V> velocity;  ///< slip velocity V_t, m/s
    V damping;            ///< friction coefficient c_t, kg/s
};

/// @param separationSq  P.P in units
/// @param approach      V.P with P in units
/// @param normalForce   conservative part of the pair force, N
template <class T>
HWY_INLINE Slip<Lanes<T>> slipOf(const Row<T>& row, Lanes<T> separationSq, Lanes<T> approach, Lanes<T> friction,
                                 Lanes<T> normalForce) {
    // The entries that pad a row have P = 0; the lower bound makes them give 0 instead of NaN.
    const auto share = hn::Div(approach, atLeast(separationSq, double{std::numeric_limits<T>::min()}));
    const auto velocity = difference(row.velocity, scaled(share, row.separation));
    return {velocity, slipDamping(friction, normalForce, dot(velocity, velocity))};
}

/// The matrix rows of the particles in a SIMD vector while they are filled. Every pair is written without a branch, but
/// the write position of a row moves on only if the pair has an entry in the matrix.
template <class T>
struct MatrixRows {
    PairMatrix* matrix;
    std::size_t first;  ///< lane slot of the particle in the first lane
    std::array<std::uint32_t, kClusterSize> length = {};

    template <bool hasFriction>
    void add(const std::int32_t* others, Lanes<T> along, Lanes<T> across, hn::Mask<Tag<T>> isPair) {
        constexpr Tag<T> kTag{};
        std::array<T, kClusterSize> alongOf, acrossOf;
        hn::StoreU(along, kTag, alongOf.data());
        auto isEntry = hn::Ne(along, hn::Zero(kTag));
        if constexpr (hasFriction) {
            hn::StoreU(across, kTag, acrossOf.data());
            isEntry = hn::Or(isEntry, hn::Ne(across, hn::Zero(kTag)));
        }
        const std::uint32_t bits = bitsOf<T>(hn::And(isPair, isEntry));
        const std::size_t block = NeighborRows::blockOf(first);
        for (std::size_t lane = 0; lane < hn::Lanes(kTag); ++lane) {
            const std::size_t at = matrix->rows.at(first + lane, length[lane]);
            matrix->rows.blocks[block].entries[at] = others[lane];
            matrix->along[block][at] = static_cast<double>(alongOf[lane]);
            if constexpr (hasFriction) matrix->across[block][at] = static_cast<double>(acrossOf[lane]);
            length[lane] += (bits >> lane) & 1U;
        }
    }

    void finish() const { std::copy_n(length.begin(), hn::Lanes(Tag<T>()), &matrix->rows.length[first]); }
};

/// The packed particles that a pass in T, double or float, reads.
template <class T>
const auto& packedIn(const PairTraversal& pairs) {
    if constexpr (std::is_same_v<T, double>)
        return pairs.packed;
    else
        return pairs.packedFloat;
}

/// Whether the next neighbors are loaded while the forces of the present neighbors are computed. With enough registers,
/// as in AVX-512, the shuffle and arithmetic units are then busy at the same time.
constexpr bool kLoadsAhead = HWY_TARGET <= HWY_AVX3;

/// Sums over the pairs of the particles in one SIMD vector, which begins at a lane of the cluster. The flatten
/// attribute inlines every call: with a call left in the loop, all vectors go through memory, which takes twice as long
/// with AVX-512.
template <class Source, Variant variant>
HWY_FLATTEN void sumLanes(const PairTraversal& pairs, const PairSums& wanted, std::size_t cluster, std::size_t lane,
                          ClusterSums& sums) {
    using T = typename Source::T;
    using V = Lanes<T>;
    constexpr Tag<T> kTag{};
    constexpr PairTerms kTerms = variant.terms;
    const std::size_t first = cluster * kClusterSize + lane;
    const NeighborRows& rows = pairs.list.rows;
    const std::uint32_t longest = longestRow<T>(rows, first);
    const Source source(packedIn<T>(pairs).data(), &rows.ownIndices[first]);
    const Law<T, variant> law(pairs, wanted.weights);
    Vector3<V> force{hn::Zero(kTag), hn::Zero(kTag), hn::Zero(kTag)};
    V energy = hn::Zero(kTag);
    auto coincident = hn::FirstN(kTag, 0);
    [[maybe_unused]] MatrixRows<T> matrixRows{wanted.matrix, first};
    const std::int32_t* entry = &rows.blocks[NeighborRows::blockOf(first)].entries[rows.at(first, 0)];
    auto ahead = source.template load<kTerms.damping>(entry);
    for (std::uint32_t k = 0; k < longest; ++k, entry += kClusterSize) {
        prefetchRows(entry);
        const auto others = kLoadsAhead ? ahead : source.template load<kTerms.damping>(entry);
        if constexpr (kLoadsAhead) ahead = source.template load<kTerms.damping>(entry + kClusterSize);
        const Row<T> row = source.template row<kTerms.damping>(entry, others);
        const V separationSq = dot(row.separation, row.separation);
        const V distanceSq = law.squareMeters(separationSq);
        const auto isCoincident = hn::And(row.isPair, hn::Eq(separationSq, hn::Zero(kTag)));
        if (HWY_UNLIKELY(!hn::AllFalse(kTag, isCoincident)))
            coincident = hn::Or(coincident, source.sharePosition(entry, isCoincident));
        V approach = hn::Zero(kTag);
        if constexpr (kTerms.damping) approach = dot(row.velocity, row.separation);
        // The entries that pad a row have P = 0, so their force is zero.
        const V inverseSq = guardedInverseSq(distanceSq, law.constants.coreSq);
        const V inverse = squareRoot(inverseSq);
        addScaled(force, coefficientFrom<kTerms>(inverseSq, inverse, approach, law.constants), row.separation);
        Slip<V> slip;
        if constexpr (kTerms.friction) {
            const V conservative = conservativeFrom<kTerms>(inverseSq, inverse, law.constants);
            slip = slipOf<T>(row, separationSq, approach, law.constants.friction,
                             hn::Mul(conservative, hn::Sqrt(distanceSq)));
            addScaled(force, law.perUnitOf(hn::Neg(slip.damping)), slip.velocity);
        }
        if constexpr (variant.hasEnergy)
            energy = hn::Add(
                energy,
                hn::IfThenElseZero(row.isPair, hn::Mul(law.set(T(0.5)), law.energy(distanceSq, inverseSq, inverse))));
        if constexpr (variant.hasMatrix) {
            const auto isPair = hn::AndNot(isCoincident, row.isPair);  // a coincident pair has no entry in the matrix
            V along = law.along(distanceSq, inverseSq, inverse);
            V across = hn::Zero(kTag);
            if constexpr (kTerms.friction) {
                // across (1 - n n^T) = across 1 - (across / D^2) P P^T
                across = hn::Mul(law.dampingWeight, slip.damping);
                along = hn::Sub(along, hn::Div(across, distanceSq));
            }
            matrixRows.template add<kTerms.friction>(entry, along, across, isPair);
        }
    }
    if constexpr (variant.hasMatrix) matrixRows.finish();
    const double unit = pairs.unit;  // a local copy, which no store below can alias: the loop vectorizes
    std::array<T, kClusterSize> x, y, z, e;
    hn::StoreU(force.x, kTag, x.data());
    hn::StoreU(force.y, kTag, y.data());
    hn::StoreU(force.z, kTag, z.data());
    hn::StoreU(energy, kTag, e.data());
    for (std::size_t k = 0; k < hn::Lanes(kTag); ++k) {
        sums.x[lane + k] = static_cast<double>(x[k]) * unit;
        sums.y[lane + k] = static_cast<double>(y[k]) * unit;
        sums.z[lane + k] = static_cast<double>(z[k]) * unit;
        sums.energy[lane + k] = static_cast<double>(e[k]);
    }
    sums.coincident |= bitsOf<T>(coincident) << lane;
}

template <class Source, Variant variant>
void sumCluster(const PairTraversal& pairs, const PairSums& wanted, std::size_t cluster, ClusterSums& sums) {
    sums.coincident = 0;
    for (std::size_t lane = 0; lane < kClusterSize; lane += hn::Lanes(Tag<typename Source::T>()))
        sumLanes<Source, variant>(pairs, wanted, cluster, lane, sums);
}

template <class Source>
ClusterKernel kernelOver(const PairTraversal& pairs, const PairSums& wanted) {
    return withVariant(pairs.terms.pair, wanted,
                       []<Variant variant>() -> ClusterKernel { return sumCluster<Source, variant>; });
}

ClusterKernel clusterKernelHere(const PairTraversal& pairs, const PairSums& wanted) {
    return pairs.packedFloat.empty() ? kernelOver<DoubleLanes>(pairs, wanted) : kernelOver<FloatLanes>(pairs, wanted);
}

const char* instructionSetHere() {
    return hwy::TargetName(HWY_TARGET);
}

}  // namespace HWY_NAMESPACE
}  // namespace engine
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace engine {

HWY_EXPORT(clusterKernelHere);
HWY_EXPORT(instructionSetHere);

ClusterKernel clusterKernel(const PairTraversal& pairs, const PairSums& wanted) {
    return HWY_DYNAMIC_DISPATCH(clusterKernelHere)(pairs, wanted);
}

const char* simdInstructionSet() {
    return HWY_DYNAMIC_DISPATCH(instructionSetHere)();
}

}  // namespace engine

#endif
