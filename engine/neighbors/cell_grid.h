// The cell grid: particles sorted into cubic cells at least as entries32 as the cutoff, so that everything a particle
// can feel is in the 27 cells around it. The grid is periodic in its indices: far away cells share storage with near
// ones and are told apart by the distance test alone. So an outlier costs nothing, memory is linear in n, and no box
// has to bound the world.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/core/vec3.h"

namespace engine {

/// Consecutive entries of CellGrid::order.
struct CellRange {
    std::uint32_t begin = 0;
    std::uint32_t end = 0;
};

/// The ranges that hold what is in and around some cells; each particle occurs in at most one.
struct Neighborhood {
    std::array<CellRange, 27> ranges;
    int count = 0;
};

struct CellGrid {
    std::array<std::int64_t, 3> dimensions{1, 1, 1};  ///< cells along x, y, z
    std::vector<std::uint32_t> start;                 ///< first entry of each cell in order, and one past the last
    std::vector<std::uint32_t> order;                 ///< particle indices by cell, x fastest; ascending within a cell
    std::vector<std::uint32_t> cellOf;                ///< cell of each particle

    std::size_t cellCount() const { return start.size() - 1; }
};

/// Sorts the positions (finite, in meters) into cells of the given width (m, above 0).
/// Holds:  the order within a cell is that of the indices, so that it depends on the positions alone.
void build(CellGrid& grid, const std::vector<Vec3>& positions, double cellWidth);

/// The cell of a sortedIndex in the order, where somebody is.
std::uint32_t cellOfSortedIndex(const CellGrid& grid, std::uint32_t sortedIndex);

/// Cells side by side along x; a cell at either end of a row is a run of its own.
struct CellRun {
    std::uint32_t first = 0;
    std::uint32_t last = 0;  ///< is one of them
};

/// The longest run from a cell on without more particles or cells than that, or the cell itself.
CellRun runFrom(const CellGrid& grid, std::uint32_t cell, std::uint32_t mostParticles, std::uint32_t mostCells);

/// The ranges in and around the cells of a run, in a fixed order, neighbors along x joined where storage is
/// consecutive.
Neighborhood neighborhood(const CellGrid& grid, const CellRun& run);

}  // namespace engine
