// The kernel, compiled once per instruction set.
#include "engine/forces/pair_matrix.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/forces/simd_product.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "engine/forces/simd_particles-inl.h"

HWY_BEFORE_NAMESPACE();
namespace engine {
namespace HWY_NAMESPACE {

/// Flattened, as the forces' kernel is.
template <bool hasFriction>
HWY_FLATTEN void multiplyBlock(const PairMatrix& matrix, std::size_t cluster, std::size_t lane,
                               ClusterProduct& product) {
    constexpr Tag<double> kTag{};
    const std::size_t first = cluster * kClusterSize + lane;
    const std::size_t block = NeighborRows::blockOf(first);
    const RowBlock& rows = matrix.rows.blocks[block];
    const Doubles source(matrix.packed.data(), &matrix.rows.ownIndices[first]);
    const std::uint32_t longest = longestRow<double>(matrix.rows, first);
    Vector3<Lanes<double>> sum{hn::Zero(kTag), hn::Zero(kTag), hn::Zero(kTag)};
    std::size_t entry = matrix.rows.at(first, 0);
    for (std::uint32_t k = 0; k < longest; ++k, entry += kClusterSize) {
        const std::int32_t* sortedIndices = &rows.entries[entry];
        fetchAhead(sortedIndices);
        fetchAhead(&matrix.along[block][entry]);
        const Row<double> row = source.row<true>(sortedIndices, source.load<true>(sortedIndices));
        const auto along = hn::LoadU(kTag, &matrix.along[block][entry]);
        const auto push = hn::Mul(along, dot(row.velocity, row.separation));
        sum.x = hn::Add(sum.x, hn::Mul(push, row.separation.x));
        sum.y = hn::Add(sum.y, hn::Mul(push, row.separation.y));
        sum.z = hn::Add(sum.z, hn::Mul(push, row.separation.z));
        if constexpr (hasFriction) {
            const auto across = hn::LoadU(kTag, &matrix.across[block][entry]);
            sum.x = hn::Add(sum.x, hn::Mul(across, row.velocity.x));
            sum.y = hn::Add(sum.y, hn::Mul(across, row.velocity.y));
            sum.z = hn::Add(sum.z, hn::Mul(across, row.velocity.z));
        }
    }
    hn::StoreU(sum.x, kTag, &product.x[lane]);
    hn::StoreU(sum.y, kTag, &product.y[lane]);
    hn::StoreU(sum.z, kTag, &product.z[lane]);
}

void multiplyLanes(const PairMatrix& matrix, std::size_t cluster, ClusterProduct& product) {
    const bool hasFriction = !matrix.across.empty();
    for (std::size_t lane = 0; lane < kClusterSize; lane += hn::Lanes(Tag<double>()))
        hasFriction ? multiplyBlock<true>(matrix, cluster, lane, product)
                    : multiplyBlock<false>(matrix, cluster, lane, product);
}

void multiplyClusterHere(const PairMatrix& matrix, std::size_t cluster, ClusterProduct& product) {
    multiplyLanes(matrix, cluster, product);
}

}  // namespace HWY_NAMESPACE
}  // namespace engine
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace engine {

HWY_EXPORT(multiplyClusterHere);

void multiplyCluster(const PairMatrix& matrix, std::size_t cluster, ClusterProduct& product) {
    HWY_DYNAMIC_DISPATCH(multiplyClusterHere)(matrix, cluster, product);
}

}  // namespace engine

#endif
