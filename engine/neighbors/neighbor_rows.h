// The rows of the neighbor list in the layout that SIMD kernels read: one particle in each lane, kClusterSize particles
// in a cluster, and the rows of a cluster interleaved. Every lane reads its own row in the order of the list, so that a
// sum over a row does not depend on the number of lanes of the instruction set. Filled by neighbor_list.cpp and
// pair_matrix.cpp, read by the kernels of engine/forces.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace engine {

/// Number of particles in a cluster: as many as the widest instruction set has float lanes.
inline constexpr std::size_t kClusterSize = 16;

/// Number of clusters in a block; a thread finds and stores the rows of a block together. Chosen: this takes some tens
/// of microseconds in a dense scene.
inline constexpr std::size_t kClustersPerBlock = 8;

/// Number of lane slots, one for each particle, in a block.
inline constexpr std::size_t kSlotsPerBlock = kClustersPerBlock * kClusterSize;

/// The neighbor rows of kClustersPerBlock clusters. The kth entries of all rows of a cluster lie side by side, as a
/// group of kClusterSize sorted indices. Kernels may read one group beyond the last.
struct RowBlock {
    std::array<std::uint32_t, kClustersPerBlock + 1> start = {};  ///< first group of each cluster
    std::vector<std::int32_t> entries;                            ///< sorted indices of neighbors
};

/// The neighbor rows of all particles. Every particle has a lane slot, the number of a cluster and a lane in it, beside
/// particles with rows of similar length. Rows that are shorter than the longest row of the cluster are padded with the
/// sorted index of their own particle.
struct NeighborRows {
    std::vector<std::int32_t> ownIndices;  ///< sorted index of the particle in each slot; the last one's in empty slots
    std::vector<std::uint32_t> length;     ///< number of neighbors of the particle in each slot; 0 in empty slots
    std::vector<RowBlock> blocks;

    std::size_t clusterCount() const { return ownIndices.size() / kClusterSize; }

    static std::size_t blockOf(std::size_t laneSlot) { return laneSlot / kSlotsPerBlock; }

    /// Index of the kth entry of a lane slot's row in the entries of its block.
    std::size_t at(std::size_t laneSlot, std::size_t k) const {
        const std::size_t cluster = laneSlot % kSlotsPerBlock / kClusterSize;
        return (blocks[blockOf(laneSlot)].start[cluster] + k) * kClusterSize + laneSlot % kClusterSize;
    }

    /// Sorted index of the kth neighbor in a lane slot's row.
    std::uint32_t sortedIndexAt(std::size_t laneSlot, std::size_t k) const {
        return static_cast<std::uint32_t>(blocks[blockOf(laneSlot)].entries[at(laneSlot, k)]);
    }
};

}  // namespace engine
