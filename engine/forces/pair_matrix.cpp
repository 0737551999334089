// Rows filled from the front, products cluster by cluster.
#include "engine/forces/pair_matrix.h"

#include <algorithm>

#include "engine/core/parallel.h"

namespace engine {

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
        const RowBlock& like = list.rows.blocks[block];
        RowBlock& rows = matrix.rows.blocks[block];
        rows.start = like.start;
        rows.entries.resize(like.entries.size());
        matrix.along[block].resize(like.entries.size());
        if (hasFriction) matrix.across[block].resize(like.entries.size());
    });
}

void close(PairMatrix& matrix) {
    inParallel(matrix.rows.clusterCount(), 16, [&](std::size_t cluster) {
        const std::size_t end = (cluster + 1) * kClusterSize;
        const std::size_t block = NeighborRows::blockOf(cluster * kClusterSize);
        std::uint32_t longest = 0;
        for (std::size_t laneSlot = cluster * kClusterSize; laneSlot < end; ++laneSlot)
            longest = std::max(longest, matrix.rows.length[laneSlot]);
        for (std::size_t laneSlot = cluster * kClusterSize; laneSlot < end; ++laneSlot) {
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
    inParallel(matrix.count(), kParticleGrain, [&](std::size_t sortedIndex) {
        PackedParticle& record = matrix.packed[sortedIndex];
        record.vx = x[sortedIndex].x();
        record.vy = x[sortedIndex].y();
        record.vz = x[sortedIndex].z();
    });
    constexpr std::size_t kGrain = 4;  // chosen: rows of a dense scene take a tenth of a microsecond each
    inParallel(matrix.rows.clusterCount(), kGrain, [&](std::size_t cluster) {
        ClusterProduct of;
        multiplyCluster(matrix, cluster, of);
        const std::size_t first = cluster * kClusterSize;
        const std::size_t end = std::min(first + kClusterSize, matrix.count());
        for (std::size_t laneSlot = first; laneSlot < end; ++laneSlot) {
            const std::size_t lane = laneSlot - first;
            const auto sortedIndex = static_cast<std::size_t>(matrix.rows.ownIndices[laneSlot]);
            product[sortedIndex] = matrix.mass[sortedIndex] * x[sortedIndex] + Vec3(of.x[lane], of.y[lane], of.z[lane]);
            if (!matrix.own.empty()) product[sortedIndex] += matrix.own[sortedIndex] * x[sortedIndex];
        }
    });
}

}  // namespace engine
