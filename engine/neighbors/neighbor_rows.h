// The rows of the neighbor list as SIMD kernels read them: one particle in each lane, kClusterSize particles in a
// cluster, the rows of a cluster interleaved. Every lane reads its own row in the list's order, so that a sum over a
// row does not depend on how many lanes the instruction set has. Filled by neighbor_list.cpp and pair_matrix.cpp, read
// by the kernels of engine/forces.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace engine {

/// Particles in a cluster: as many as the widest instruction set has lanes of floats.
inline constexpr std::size_t kClusterSize = 16;

/// Clusters whose rows are found and stored together, by one thread. Chosen: finding them takes some tens of
/// microseconds in a dense scene.
inline constexpr std::size_t kClustersPerBlock = 8;

/// Lane slots in a block.
inline constexpr std::size_t kSlotsPerBlock = kClustersPerBlock * kClusterSize;

/// The rows of kClustersPerBlock clusters. Entry k of every lane of a cluster stands side by side: kClusterSize sorted
/// indices. Kernels may read one such group of entries beyond the last.
struct RowBlock {
    std::array<std::uint32_t, kClustersPerBlock + 1> start = {};  ///< of each cluster, in groups of kClusterSize
    std::vector<std::int32_t> entries;                            ///< sorted indices of neighbors
};

/// Every particle has a lane slot: its cluster and its lane there, beside particles with rows of similar length. Rows
/// that are shorter than the longest of their cluster are padded with the sorted index of their own particle.
struct NeighborRows {
    std::vector<std::int32_t> ownIndices;  ///< sorted index of the particle in each slot; the last one's in empty slots
    std::vector<std::uint32_t> length;     ///< neighbors of the particle in each slot; 0 in empty slots
    std::vector<RowBlock> blocks;

    std::size_t clusterCount() const { return ownIndices.size() / kClusterSize; }

    static std::size_t blockOf(std::size_t laneSlot) { return laneSlot / kSlotsPerBlock; }

    /// Position of entry k of a slot's row in the entries of its block.
    std::size_t at(std::size_t laneSlot, std::size_t k) const {
        const std::size_t cluster = laneSlot % kSlotsPerBlock / kClusterSize;
        return (blocks[blockOf(laneSlot)].start[cluster] + k) * kClusterSize + laneSlot % kClusterSize;
    }

    /// Sorted index in entry k of a slot's row.
    std::uint32_t sortedIndexAt(std::size_t laneSlot, std::size_t k) const {
        return static_cast<std::uint32_t>(blocks[blockOf(laneSlot)].entries[at(laneSlot, k)]);
    }
};

}  // namespace engine
