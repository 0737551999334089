// The neighbor list: for every particle all others within the cutoff and a skin around it. It serves until some
// particle has moved by half the skin relative to the motion that all have in common. So most steps need no search, and
// particles in free fall together need none at all. Kept by PairTraversal.
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
    CellGrid grid;  ///< its order is that of an older list
    Candidates candidates;
};

/// Every particle has two positions in the list. Its sorted index is its rank in the order of the grid cells. Its lane
/// slot says which row is its own; it lies in the same block as the sorted index, and within a block the longest rows
/// come first, so that the lanes of a cluster finish together.
struct NeighborList {
    std::vector<std::uint32_t> order;          ///< particle index at each sorted index
    std::vector<std::uint32_t> sortedIndexOf;  ///< sorted index of each particle index
    NeighborRows rows;                         ///< neighbors of the particle in each lane slot
    std::size_t entryCount = 0;                ///< sum of the lengths of all rows
    std::vector<Vec3> builtAt;                 ///< positions by particle index when the list was built, m
    double reach = 0.0;                        ///< cutoff and skin together, m
    Scratch<BuildScratch> scratch;

    std::size_t count() const { return order.size(); }

    /// Lane slot of a particle index, found by searching its block.
    std::size_t laneSlotOf(std::size_t p) const;
};

/// Builds the list for positions in meters. The rows are the same for any number of threads and any instruction set.
/// @param cutoff  in meters, at least 0
/// @param skin    in meters, at least 0
void build(NeighborList& list, const std::vector<Vec3>& positions, double cutoff, double skin);

/// Whether every pair closer than the cutoff (m) at these positions (m) is certain to be in the list.
bool covers(const NeighborList& list, const std::vector<Vec3>& positions, double cutoff);

/// Skin in cutoffs where nothing is known of the motion. Chosen: right for a liquid.
inline constexpr double kDefaultSkin = 0.1;

/// The skin, in cutoffs, at which building lists and passing over them costs least per step. A wide skin serves for
/// many steps, a narrow one makes short rows.
/// @param neighbors     mean number of neighbors within the cutoff
/// @param displacement  of the fastest particle in a step, in cutoffs
double optimalSkin(double neighbors, double displacement);

/// Entries for which the rows have room, padding included.
std::size_t roomOf(const NeighborRows& rows);

/// Bytes that the rows hold.
std::size_t bytesOf(const NeighborRows& rows);

/// Bytes that the list holds, with the scratch of its build.
std::size_t bytesOf(const NeighborList& list);

}  // namespace engine
