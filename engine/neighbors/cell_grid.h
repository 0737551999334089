// The cell grid: particles sorted into cubic cells at least as wide as the cutoff, so that all neighbors of a particle
// are in the 27 cells around it. The grid is periodic in its indices: cells far apart share storage, and the distance
// test alone tells their particles apart. So an outlier costs nothing, memory is linear in the number of particles, and
// no box has to bound the world. Built by neighbor_list.cpp; linked_cells.cpp uses the cell numbers.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "engine/core/vec3.h"

namespace engine {

/// Cells are made this much wider than asked for, which covers the rounding of x / width for any |x| below 1e9 widths.
inline constexpr double kRoundingMargin = 1.0 + 1e-6;

/// Number of the cell along an axis that contains a coordinate: coordinate / width rounded down, both in meters.
/// Clamped to +-1e15, which is far outside all worlds; -1e15 or 1e15 for NaN as well.
std::int64_t cellNumber(double coordinate, double width);

/// Cells along one axis of a periodic grid.
struct CellAxis {
    double width;         ///< m
    std::int64_t size;    ///< number of cells
    std::int64_t first;   ///< number of the lowest cell that contains a particle
    std::int64_t stored;  ///< index at which that cell is stored

    CellAxis(double cellWidth, std::int64_t cells, double lowest);

    /// Storage index of the cell that contains a coordinate (m), 0 ... size - 1.
    std::int64_t cellOf(double coordinate) const;
};

using CellAxes = std::array<CellAxis, 3>;

/// Storage index of the cell that contains a position, x fastest.
std::uint32_t cellAt(const CellAxes& axes, const Vec3& position);

/// cellAt() for many positions at once, with the same result on any instruction set.
void findCells(const CellAxes& axes, const Vec3* positions, std::size_t count, std::uint32_t* cells);

/// Consecutive entries of CellGrid::order.
struct CellRange {
    std::uint32_t begin = 0;
    std::uint32_t end = 0;
};

/// The ranges that hold the particles in and around some cells; each particle occurs in at most one.
struct Neighborhood {
    std::array<CellRange, 27> ranges;
    int count = 0;
};

struct CellGrid {
    std::array<std::int64_t, 3> dimensions{1, 1, 1};  ///< cells along x, y, z
    std::vector<std::uint32_t> start;                 ///< first entry of each cell in order, and one past the last
    std::vector<std::uint32_t> order;                 ///< particle indices by cell, ascending within a cell
    std::vector<std::uint32_t> cellOf;                ///< cell of each particle

    std::size_t cellCount() const { return start.size() - 1; }
};

/// Sorts positions (m) into cells of the given width (m, above 0). Positions that are not finite do no harm to the
/// others; the check after the step reports them.
void build(CellGrid& grid, const std::vector<Vec3>& positions, double cellWidth);

/// The cell that holds an entry of the order.
std::uint32_t cellOfSortedIndex(const CellGrid& grid, std::uint32_t sortedIndex);

/// Cells side by side along x. A cell at either end of a line of cells is a run of its own.
struct CellRun {
    std::uint32_t first = 0;
    std::uint32_t last = 0;  ///< inclusive
};

/// The longest run that begins with a cell and has at most so many particles and cells, but at least that cell.
CellRun runFrom(const CellGrid& grid, std::uint32_t cell, std::uint32_t mostParticles, std::uint32_t mostCells);

/// The ranges in and around the cells of a run, in a fixed order. Neighboring ranges are joined where they are
/// consecutive in storage.
Neighborhood neighborhood(const CellGrid& grid, const CellRun& run);

}  // namespace engine
