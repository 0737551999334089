// Rows of neighbors as vector units read them: a particle a lane, sixteen particles a cluster, the rows of a cluster
// interleaved. Every lane walks its own row in the list's order, so that a sum over it does not depend on how many
// lanes an instruction set has.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace engine {

/// As many lanes as the widest instruction set has of the smallest number.
inline constexpr std::size_t kClusterSize = 16;

/// Groups whose rows are found and kept together, and whose neighbors are mostly the same. Chosen: some tens of
/// microseconds in a dense scene.
inline constexpr std::size_t kClustersPerBlock = 8;

/// Seats of a block.
inline constexpr std::size_t kSlotsPerBlock = kClustersPerBlock * kClusterSize;

/// The rows of some clusters: sortedIndices counted from a base, in half a word each, unless what is around the
/// clusters spans too many of them. Kernels read one row beyond the last.
struct RowBlock {
    std::array<std::uint32_t, kClustersPerBlock + 1> start = {};  ///< of each cluster, in rows of kClusterSize entries
    std::uint32_t base = 0;
    std::vector<std::uint16_t> entries16;
    std::vector<std::int32_t> entries32;  ///< empty where entries16 ones suffice

    bool uses32Bits() const { return !entries32.empty(); }

    /// The sortedIndex that an entry stands for.
    std::uint32_t sortedIndexAt(std::size_t at) const {
        return base + (uses32Bits() ? static_cast<std::uint32_t>(entries32[at]) : entries16[at]);
    }

    std::size_t bytes() const {
        return entries16.capacity() * sizeof(entries16[0]) + entries32.capacity() * sizeof(entries32[0]);
    }

    void setSortedIndex(std::size_t at, std::uint32_t sortedIndex) {
        if (uses32Bits())
            entries32[at] = static_cast<std::int32_t>(sortedIndex - base);
        else
            entries16[at] = static_cast<std::uint16_t>(sortedIndex - base);
    }
};

/// A block's entries of either width.
template <class Entry, class Part>
auto& entriesOf(Part& block) {
    if constexpr (sizeof(Entry) == sizeof(std::uint16_t))
        return block.entries16;
    else
        return block.entries32;
}

/// Each particle has a laneSlot, a lane of a cluster, beside others with rows of like length. Rows that are shorter
/// than the longest of their cluster are filled up with their own particle's sortedIndex.
struct NeighborRows {
    std::vector<std::int32_t>
        ownIndices;                     ///< sortedIndex of the particle in each laneSlot; beyond the last, the last one
    std::vector<std::uint32_t> length;  ///< entries of each laneSlot's row; 0 beyond the last
    std::vector<RowBlock> blocks;

    std::size_t clusterCount() const { return ownIndices.size() / kClusterSize; }

    static std::size_t blockOf(std::size_t laneSlot) { return laneSlot / kSlotsPerBlock; }

    /// Where entry k of a laneSlot's row stands in its block.
    std::size_t at(std::size_t laneSlot, std::size_t k) const {
        const std::size_t cluster = laneSlot % kSlotsPerBlock / kClusterSize;
        return (blocks[blockOf(laneSlot)].start[cluster] + k) * kClusterSize + laneSlot % kClusterSize;
    }

    /// The sortedIndex that entry k of a laneSlot's row stands for.
    std::uint32_t sortedIndexAt(std::size_t laneSlot, std::size_t k) const {
        return blocks[blockOf(laneSlot)].sortedIndexAt(at(laneSlot, k));
    }
};

}  // namespace engine
