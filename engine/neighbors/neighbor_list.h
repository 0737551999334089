// Who is near whom: for every particle the sortedIndices of all others within the cutoff and a skin around it. The list
// serves as long as no particle has moved by half the skin beside what all have in common, so that most steps need no
// search and a crowd that falls as one needs none at all. Kept by PairTraversal.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/core/scratch.h"
#include "engine/neighbors/cell_grid.h"
#include "engine/neighbors/list_search.h"
#include "engine/neighbors/neighbor_rows.h"

namespace engine {

/// Memory of a build.
struct BuildScratch {
    CellGrid grid;  ///< its order is an older one
    Candidates candidates;
};

/// Particles have sortedIndices, which follow the cells of the grid that the list was built with, and lane slots, in
/// the same block, of which the longest rows come first.
struct NeighborList {
    std::vector<std::uint32_t> order;          ///< particle index at each sortedIndex
    std::vector<std::uint32_t> sortedIndexOf;  ///< of each particle index
    NeighborRows rows;                         ///< neighbors of each laneSlot
    std::size_t entryCount = 0;                ///< of all rows
    std::vector<Vec3> builtAt;                 ///< positions by particle index when the list was built, m
    double reach = 0.0;                        ///< cutoff and skin together, m
    Scratch<BuildScratch> scratch;

    std::size_t count() const { return order.size(); }

    /// Seat of a particle index.
    std::size_t laneSlotOf(std::size_t p) const;
};

/// Builds the list for positions in meters. Holds: the same rows for any number of threads and any instruction set.
/// Shape:  cutoff and skin in meters, at least 0.
void build(NeighborList& list, const std::vector<Vec3>& positions, double cutoff, double skin);

/// Whether every pair closer than the cutoff (m) is certainly in the list.
bool covers(const NeighborList& list, const std::vector<Vec3>& positions, double cutoff);

/// Entries for which the rows have room, with those that fill them up.
std::size_t roomOf(const NeighborRows& rows);

/// Bytes that the rows hold.
std::size_t bytesOf(const NeighborRows& rows);

/// Bytes that the list holds, with the scratch of its build.
std::size_t bytesOf(const NeighborList& list);

}  // namespace engine
