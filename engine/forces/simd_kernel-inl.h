// The SIMD kernel that sums over the neighbors of a cluster of particles. A neighbor beyond the cutoff is not skipped
// but adds zeros. Highway includes this file once per instruction set, hence the unusual include guard below.
#if defined(ENGINE_SIMD_KERNEL_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef ENGINE_SIMD_KERNEL_INL_H
#undef ENGINE_SIMD_KERNEL_INL_H
#else
#define ENGINE_SIMD_KERNEL_INL_H
#endif

#include <algorithm>
#include <limits>

#include "engine/forces/simd_forces.h"
#include "engine/forces/simd_law-inl.h"

HWY_BEFORE_NAMESPACE();
namespace engine {
namespace HWY_NAMESPACE {

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
template <class Source, class Laws, Variant variant>
HWY_FLATTEN void sumLanes(const PairTraversal& pairs, const PairSums& wanted, std::size_t cluster, std::size_t lane,
                          ClusterSums& sums) {
    using T = typename Source::T;
    using V = Lanes<T>;
    constexpr Tag<T> kTag{};
    constexpr PairTerms kTerms = variant.terms;
    const std::size_t first = cluster * kClusterSize + lane;
    const NeighborRows& rows = pairs.list.rows;
    const std::uint32_t longest = longestRow<T>(rows, first);
    const Source source(packedIn<T>(pairs), &rows.ownIndices[first]);
    const Laws laws(pairs, wanted.weights, source, &rows.ownIndices[first]);
    Vector3<V> force{hn::Zero(kTag), hn::Zero(kTag), hn::Zero(kTag)};
    V energy = hn::Zero(kTag);
    auto coincident = hn::FirstN(kTag, 0);
    [[maybe_unused]] MatrixRows<T> matrixRows{wanted.matrix, first};
    const std::int32_t* entry = &rows.blocks[NeighborRows::blockOf(first)].entries[rows.at(first, 0)];
    auto ahead = source.template load<kTerms.damping>(entry);
    auto traitsAhead = laws.traits(entry);
    for (std::uint32_t k = 0; k < longest; ++k, entry += kClusterSize) {
        prefetchRows(entry);
        const auto others = kLoadsAhead ? ahead : source.template load<kTerms.damping>(entry);
        const auto traits = kLoadsAhead ? traitsAhead : laws.traits(entry);
        if constexpr (kLoadsAhead) traitsAhead = laws.traits(entry + kClusterSize);
        if constexpr (kLoadsAhead) ahead = source.template load<kTerms.damping>(entry + kClusterSize);
        const Law<T, variant>& law = laws.of(entry, traits);
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
        addScaled(force, coefficientFrom<kTerms>(distanceSq, inverseSq, inverse, approach, law.constants),
                  row.separation);
        Slip<V> slip;
        if constexpr (kTerms.friction) {
            const V conservative = conservativeFrom<kTerms>(distanceSq, inverseSq, inverse, law.constants);
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

template <class Source, template <class, Variant> class Laws, Variant variant>
void sumCluster(const PairTraversal& pairs, const PairSums& wanted, std::size_t cluster, ClusterSums& sums) {
    sums.coincident = 0;
    for (std::size_t lane = 0; lane < kClusterSize; lane += hn::Lanes(Tag<typename Source::T>()))
        sumLanes<Source, Laws<Source, variant>, variant>(pairs, wanted, cluster, lane, sums);
}

template <class Source, template <class, Variant> class Laws>
ClusterKernel kernelOver(const PairTraversal& pairs, const PairSums& wanted) {
    return withVariant(pairs.terms.pair, wanted,
                       []<Variant variant>() -> ClusterKernel { return sumCluster<Source, Laws, variant>; });
}

/// The kernel for a pass whose pairs have the given kind of laws.
template <template <class, Variant> class Laws>
ClusterKernel kernelFor(const PairTraversal& pairs, const PairSums& wanted) {
    return pairs.packedFloat.empty() ? kernelOver<DoubleLanes, Laws>(pairs, wanted)
                                     : kernelOver<FloatLanes, Laws>(pairs, wanted);
}

}  // namespace HWY_NAMESPACE
}  // namespace engine
HWY_AFTER_NAMESPACE();

#endif
