// Fills the rows of the implicit steppers' matrix and multiplies it with vectors. The SIMD kernel of the product is
// compiled once per instruction set.
#include "engine/forces/pair_matrix.h"

#include <algorithm>
#include <array>

#include "engine/core/parallel.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/forces/pair_matrix.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "engine/forces/simd_particles-inl.h"

HWY_BEFORE_NAMESPACE();
namespace engine {
namespace HWY_NAMESPACE {

/// Product of the matrix without its diagonal blocks and a vector v, for the particles in the lanes of a SIMD vector:
/// the sum over each particle's neighbors of along P (P . d) + across d, where d is the difference of v between the two
/// particles. Written to x, y and z by lane. All calls are inlined by the attribute, as in the kernel of the forces.
template <bool hasFriction>
HWY_FLATTEN void multiplyLanes(const PairMatrix& matrix, std::size_t firstSlot, double* x, double* y, double* z) {
    constexpr Tag<double> kTag{};
    const std::size_t block = NeighborRows::blockOf(firstSlot);
    const RowBlock& rows = matrix.rows.blocks[block];
    const DoubleLanes source(matrix.packed, &matrix.rows.ownIndices[firstSlot]);
    const std::uint32_t longest = longestRow<double>(matrix.rows, firstSlot);
    Vector3<Lanes<double>> sum{hn::Zero(kTag), hn::Zero(kTag), hn::Zero(kTag)};
    std::size_t entry = matrix.rows.at(firstSlot, 0);
    for (std::uint32_t k = 0; k < longest; ++k, entry += kClusterSize) {
        const std::int32_t* indices = &rows.entries[entry];
        prefetchRows(indices);
        prefetchRows(&matrix.along[block][entry]);
        const Row<double> row = source.row<true>(indices, source.load<true>(indices));
        const auto along = hn::LoadU(kTag, &matrix.along[block][entry]);
        addScaled(sum, hn::Mul(along, dot(row.velocity, row.separation)), row.separation);
        if constexpr (hasFriction) addScaled(sum, hn::LoadU(kTag, &matrix.across[block][entry]), row.velocity);
    }
    hn::StoreU(sum.x, kTag, x);
    hn::StoreU(sum.y, kTag, y);
    hn::StoreU(sum.z, kTag, z);
}

void multiplyClusterHere(const PairMatrix& matrix, std::size_t cluster, std::vector<Vec3>& product) {
    std::array<double, kClusterSize> x, y, z;
    for (std::size_t lane = 0; lane < kClusterSize; lane += hn::Lanes(Tag<double>())) {
        const std::size_t firstSlot = cluster * kClusterSize + lane;
        matrix.across.empty() ? multiplyLanes<false>(matrix, firstSlot, &x[lane], &y[lane], &z[lane])
                              : multiplyLanes<true>(matrix, firstSlot, &x[lane], &y[lane], &z[lane]);
    }
    const std::size_t first = cluster * kClusterSize;
    for (std::size_t laneSlot = first; laneSlot < std::min(first + kClusterSize, matrix.count()); ++laneSlot) {
        const auto k = static_cast<std::size_t>(matrix.rows.ownIndices[laneSlot]);
        const PackedParticle& factor = matrix.packed[k];
        const Vec3 own(factor.vx, factor.vy, factor.vz);
        product[k] = matrix.mass[k] * own + Vec3(x[laneSlot - first], y[laneSlot - first], z[laneSlot - first]);
        if (!matrix.own.empty()) product[k] += matrix.own[k] * own;
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace engine
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace engine {

HWY_EXPORT(multiplyClusterHere);

void PairMatrix::add(std::size_t laneSlot, std::uint32_t other, double alongOf, double acrossOf) {
    const std::size_t block = NeighborRows::blockOf(laneSlot);
    const std::size_t at = rows.at(laneSlot, rows.length[laneSlot]++);
    rows.blocks[block].entries[at] = static_cast<std::int32_t>(other);
    along[block][at] = alongOf;
    if (!across.empty()) across[block][at] = acrossOf;
}

void makeRoom(PairMatrix& matrix, const NeighborList& list, bool hasFriction) {
    const std::size_t blocks = list.rows.blocks.size();
    matrix.rows.ownIndices = list.rows.ownIndices;
    matrix.rows.length.assign(list.rows.length.size(), 0);
    matrix.rows.blocks.resize(blocks);
    matrix.along.resize(blocks);
    matrix.across.resize(hasFriction ? blocks : 0);
    inParallel(blocks, 1, [&](std::size_t block) {
        const std::size_t room = list.rows.blocks[block].entries.size();
        matrix.rows.blocks[block].start = list.rows.blocks[block].start;
        matrix.rows.blocks[block].entries.resize(room);
        matrix.along[block].resize(room);
        if (hasFriction) matrix.across[block].resize(room);
    });
}

void padRows(PairMatrix& matrix) {
    constexpr std::size_t kGrain = 16;  // fewest clusters a thread; chosen: one takes a fraction of a microsecond
    inParallel(matrix.rows.clusterCount(), kGrain, [&](std::size_t cluster) {
        const std::size_t first = cluster * kClusterSize;
        const std::size_t block = NeighborRows::blockOf(first);
        const std::uint32_t longest =
            *std::max_element(&matrix.rows.length[first], &matrix.rows.length[first] + kClusterSize);
        for (std::size_t laneSlot = first; laneSlot < first + kClusterSize; ++laneSlot) {
            for (std::uint32_t k = matrix.rows.length[laneSlot]; k < longest; ++k) {
                const std::size_t at = matrix.rows.at(laneSlot, k);
                matrix.rows.blocks[block].entries[at] = matrix.rows.ownIndices[laneSlot];
                matrix.along[block][at] = 0.0;
                if (!matrix.across.empty()) matrix.across[block][at] = 0.0;
            }
        }
    });
}

void multiply(PairMatrix& matrix, const std::vector<Vec3>& x, std::vector<Vec3>& product) {
    product.resize(matrix.count());
    inParallel(matrix.count(), kParticleGrain, [&](std::size_t k) {
        PackedParticle& particle = matrix.packed[k];
        particle.vx = x[k].x();
        particle.vy = x[k].y();
        particle.vz = x[k].z();
    });
    constexpr std::size_t kGrain = 4;  // fewest clusters a thread; chosen: each row of one takes up to 0.1 microseconds
    inParallel(matrix.rows.clusterCount(), kGrain, [&](std::size_t cluster) {
        HWY_DYNAMIC_DISPATCH(multiplyClusterHere)(matrix, cluster, product);
    });
}

}  // namespace engine

#endif
