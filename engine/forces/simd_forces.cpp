// The kernel, compiled once per instruction set.
#include "engine/forces/simd_forces.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/forces/simd_forces.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "engine/forces/simd_law-inl.h"

HWY_BEFORE_NAMESPACE();
namespace engine {
namespace HWY_NAMESPACE {

Doubles sourceOf(const SimdPass& pass, const std::int32_t* ownIndices, Doubles* /*kind*/) {
    return Doubles(pass.packed.data(), ownIndices);
}

Singles sourceOf(const SimdPass& pass, const std::int32_t* ownIndices, Singles* /*kind*/) {
    return Singles(pass.packedFloats.data(), ownIndices);
}

/// The matrix's rows of a block of lanes as they fill up: every pair is written, and the sortedIndex to write moves on
/// where it has an entry.
template <class T>
struct MatrixRows {
    PairMatrix* matrix;
    std::size_t first;  ///< laneSlot of the first lane
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

/// Whether a row is read while the one before it is worked on. Where registers suffice, the units that shuffle what is
/// read and those that calculate are then busy together.
constexpr bool kReadsAhead = HWY_TARGET <= HWY_AVX3;

/// sum += factor * vector
template <class V>
void add(Vector3<V>& sum, V factor, const Vector3<V>& vector) {
    sum.x = hn::Add(sum.x, hn::Mul(factor, vector.x));
    sum.y = hn::Add(sum.y, hn::Mul(factor, vector.y));
    sum.z = hn::Add(sum.z, hn::Mul(factor, vector.z));
}

/// A block of lanes of a cluster, from one of its lanes on. Flattened: where anything in the loop is a call, every
/// vector goes through memory and it takes twice as long under AVX-512.
template <class Source, class Kind>
HWY_FLATTEN void addUpBlock(const SimdPass& pass, std::size_t cluster, std::size_t lane, ClusterSums& sums) {
    using T = typename Source::T;
    constexpr Tag<T> kTag{};
    const std::size_t first = cluster * kClusterSize + lane;
    const std::uint32_t longest = longestRow<T>(pass.rows, first);
    const RowBlock& block = pass.rows.blocks[NeighborRows::blockOf(first)];
    const Source source = sourceOf(pass, &pass.rows.ownIndices[first], static_cast<Source*>(nullptr));
    const Law<T, Kind> law(pass.constants, pass.weights, pass.unit);
    Vector3<Lanes<T>> force{hn::Zero(kTag), hn::Zero(kTag), hn::Zero(kTag)};
    Lanes<T> energy = hn::Zero(kTag);
    auto coincident = hn::FirstN(kTag, 0);
    [[maybe_unused]] MatrixRows<T> matrixRows{pass.matrix, first};
    const std::int32_t* entry = &block.entries[pass.rows.at(first, 0)];
    constexpr bool kVelocity = Kind::kPair.damping;
    auto ahead = source.template load<kVelocity>(entry);
    for (std::uint32_t k = 0; k < longest; ++k, entry += kClusterSize) {
        fetchAhead(entry);
        const auto others = kReadsAhead ? ahead : source.template load<kVelocity>(entry);
        if constexpr (kReadsAhead) ahead = source.template load<kVelocity>(entry + kClusterSize);
        const Row<T> row = source.template row<kVelocity>(entry, others);
        const Lanes<T> separationSq = dot(row.separation, row.separation);
        const Lanes<T> distanceSq = law.squareMeters(separationSq);
        const auto isCoincident = hn::And(row.isPair, hn::Eq(separationSq, hn::Zero(kTag)));
        if (HWY_UNLIKELY(!hn::AllFalse(kTag, isCoincident)))
            coincident = hn::Or(coincident, source.sharePlace(entry, isCoincident));
        Lanes<T> approach = hn::Zero(kTag);
        if constexpr (Kind::kPair.damping) approach = dot(row.velocity, row.separation);
        // A sortedIndex that fills up a row is the particle itself, for which P is zero.
        const auto inverse = law.inverseOf(distanceSq);
        const Lanes<T> conservative = law.conservative(inverse);
        add(force, law.coefficient(inverse, approach, conservative), row.separation);
        typename Law<T, Kind>::Slip slip;
        if constexpr (Kind::kPair.friction) {
            slip = law.slipOf(row, separationSq, approach, conservative);
            add(force, law.inUnits(hn::Neg(slip.damping)), slip.velocity);
        }
        if constexpr (Kind::kEnergy)
            energy = hn::Add(energy, hn::IfThenElseZero(row.isPair, hn::Mul(Law<T, Kind>::set(T(0.5)),
                                                                            law.energy(inverse, distanceSq))));
        if constexpr (Kind::kMatrix) {
            const auto isPair = hn::AndNot(isCoincident, row.isPair);  // a coincident pair has no direction
            Lanes<T> along = law.along(inverse, distanceSq);
            Lanes<T> across = hn::Zero(kTag);
            if constexpr (Kind::kPair.friction) {
                // across (1 - n n^T) = across 1 - (across / D^2) P P^T
                across = hn::Mul(law.dampingWeight, slip.damping);
                along = hn::Sub(along, hn::Div(across, distanceSq));
            }
            matrixRows.template add<Kind::kPair.friction>(entry, along, across, isPair);
        }
    }
    if constexpr (Kind::kMatrix) matrixRows.finish();
    const double unit = pass.unit;  // here, where nobody can change it meanwhile: the loop becomes one of vectors
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

template <class Source, class Kind>
void addUpLanes(const SimdPass& pass, std::size_t cluster, ClusterSums& sums) {
    const std::size_t step = hn::Lanes(Tag<typename Source::T>());
    for (std::size_t lane = 0; lane < kClusterSize; lane += step) addUpBlock<Source, Kind>(pass, cluster, lane, sums);
}

template <class Source, PairTerms terms>
void addUpWith(const SimdPass& pass, std::size_t cluster, ClusterSums& sums) {
    if (pass.matrix != nullptr)
        addUpLanes<Source, Terms<terms, Besides::energyAndMatrix>>(pass, cluster, sums);
    else if (pass.energy)
        addUpLanes<Source, Terms<terms, Besides::energy>>(pass, cluster, sums);
    else
        addUpLanes<Source, Terms<terms, Besides::nothing>>(pass, cluster, sums);
}

template <class Source>
void addUpFrom(const SimdPass& pass, std::size_t cluster, ClusterSums& sums) {
    if (pass.terms.friction)
        addUpWith<Source, PairTerms{true, true, true}>(pass, cluster, sums);
    else if (pass.terms.damping && pass.terms.oneReach)
        addUpWith<Source, PairTerms{true, true, false, true}>(pass, cluster, sums);
    else if (pass.terms.attraction)
        pass.terms.damping ? addUpWith<Source, PairTerms{true, true}>(pass, cluster, sums)
                           : addUpWith<Source, PairTerms{true, false}>(pass, cluster, sums);
    else
        pass.terms.damping ? addUpWith<Source, PairTerms{false, true}>(pass, cluster, sums)
                           : addUpWith<Source, PairTerms{false, false}>(pass, cluster, sums);
}

void addUpClusterHere(const SimdPass& pass, std::size_t cluster, ClusterSums& sums) {
    sums.coincident = 0;
    if (pass.packedFloats.empty())
        addUpFrom<Doubles>(pass, cluster, sums);
    else
        addUpFrom<Singles>(pass, cluster, sums);
}

const char* instructionSetHere() {
    return hwy::TargetName(HWY_TARGET);
}

}  // namespace HWY_NAMESPACE
}  // namespace engine
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace engine {

HWY_EXPORT(addUpClusterHere);
HWY_EXPORT(instructionSetHere);

void addUpCluster(const SimdPass& pass, std::size_t cluster, ClusterSums& sums) {
    HWY_DYNAMIC_DISPATCH(addUpClusterHere)(pass, cluster, sums);
}

const char* simdInstructionSet() {
    return HWY_DYNAMIC_DISPATCH(instructionSetHere)();
}

}  // namespace engine

#endif
