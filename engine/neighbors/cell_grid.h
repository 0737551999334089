// The cell grid: particles sorted into cubic cells at least as wide as the cutoff, so that all neighbors of a particle
// are in the 27 cells around it. The grid is periodic in its cell indices: cells that are far apart may share storage,
// and particles of such cells are told apart by their distance. An outlier therefore costs nothing, memory is linear in
// the number of particles, and the world need not be bounded. Built by neighbor_list.cpp; linked_cells.cpp uses the
// cell numbers.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/core/bounding_box.h"
#include "engine/core/vec3.h"

namespace engine {

/// Factor by which cells are wider than requested. It covers the rounding of x / width for any |x| below 1e9 widths.
inline constexpr double kRoundingMargin = 1.0 + 1e-6;

/// Number of the cell that contains a coordinate along an axis: coordinate / width (both in m) rounded down. Clamped to
/// +-1e15, which is far outside any world; a NaN also gives one of these two numbers. This and what follows is inline,
/// because it also runs inside of loops that are compiled for an instruction set of their own.
inline std::int64_t cellNumber(double coordinate, double width) {
    constexpr double kLargest = 1e15;  // an integer that double represents exactly
    const double cells = std::max(-kLargest, std::min(kLargest, coordinate / width));
    const auto towardZero = static_cast<std::int64_t>(cells);  // one instruction, where std::floor is a call
    return static_cast<double>(towardZero) > cells ? towardZero - 1 : towardZero;
}

/// The index modulo size, 0 or more.
inline std::int64_t wrapped(std::int64_t index, std::int64_t size) {
    const std::int64_t rest = index % size;
    return rest < 0 ? rest + size : rest;
}

/// The index modulo size, for an index that is outside by at most one size. A division would take as long as everything
/// else that finds the cell of a position.
inline std::int64_t wrappedStep(std::int64_t index, std::int64_t size) {
    if (index < 0) return index + size;
    return index < size ? index : index - size;
}

/// The cells along one axis of a periodic cell grid.
struct CellAxis {
    double width;         ///< m
    std::int64_t size;    ///< number of cells
    std::int64_t first;   ///< number of the lowest cell that contains a particle
    std::int64_t stored;  ///< storage index of the lowest cell

    CellAxis(double cellWidth, std::int64_t cells, double lowest)
        : width(cellWidth), size(cells), first(cellNumber(lowest, width)), stored(wrapped(first, size)) {}

    /// Storage index of the cell that contains a coordinate (m), 0 ... size - 1.
    std::int64_t cellOf(double coordinate) const {
        const std::int64_t number = cellNumber(coordinate, width);
        const std::int64_t steps = number - first;
        if (steps < 0 || steps >= size) return wrapped(number, size);
        return wrappedStep(stored + steps, size);  // the usual case needs no division
    }
};

using CellAxes = std::array<CellAxis, 3>;

/// Storage index of the cell that contains a position, x fastest.
inline std::uint32_t cellAt(const CellAxes& axes, const Vec3& position) {
    const std::int64_t row = axes[2].cellOf(position.z()) * axes[1].size + axes[1].cellOf(position.y());
    return static_cast<std::uint32_t>(row * axes[0].size + axes[0].cellOf(position.x()));
}

/// Finds the storage indices of the cells of many positions (m) at once, with the same result on any instruction set.
void findCells(const CellAxes& axes, const Vec3* positions, std::size_t count, std::uint32_t* cells);

/// A range of consecutive particles in the order of the cell grid.
struct CellRange {
    std::uint32_t begin = 0;
    std::uint32_t end = 0;
};

/// The ranges of particles in a group of cells and in the cells around them; each particle is in at most one range.
struct Neighborhood {
    std::array<CellRange, 27> ranges;
    int count = 0;

    std::span<CellRange> used() { return std::span(ranges).first(static_cast<std::size_t>(count)); }
};

struct CellGrid {
    double width = 1.0;                               ///< of a cell, m
    std::array<std::int64_t, 3> dimensions{1, 1, 1};  ///< numbers of cells along x, y, z; at least 3 with particles
    std::vector<std::uint32_t> start;                 ///< index in `order` of each cell's first particle, and the end
    std::vector<std::uint32_t> order;                 ///< particle indices sorted by cell, ascending within a cell
    std::vector<std::uint32_t> cellOf;                ///< storage index of the cell of each particle

    std::size_t cellCount() const { return start.size() - 1; }
};

/// Sorts positions (m) into cells of the given width (m, above 0). Positions that are not finite do not affect the
/// cells of other positions; the check after the time step reports them.
void build(CellGrid& grid, const std::vector<Vec3>& positions, double cellWidth);

/// The cell of the particle at a sorted index, that is at an index of the grid's order.
std::uint32_t cellOfSortedIndex(const CellGrid& grid, std::uint32_t sortedIndex);

/// A run of cells side by side along x. The first and the last cell along x are always runs of one cell.
struct CellRun {
    std::uint32_t first = 0;
    std::uint32_t last = 0;  ///< last cell of the run, inclusive
};

/// The longest run that begins with the given cell and has at most `mostParticles` particles and `mostCells` cells. It
/// always contains the given cell.
CellRun runFrom(const CellGrid& grid, std::uint32_t cell, std::uint32_t mostParticles, std::uint32_t mostCells);

/// The ranges of particles in the cells of a run and in the cells around them, in a fixed order. Ranges that are
/// consecutive in storage are joined.
Neighborhood neighborhood(const CellGrid& grid, const CellRun& run);

/// Appends the ranges of the cells that a box (m) intersects, each cell once, in a fixed order. Adjacent ranges are
/// merged where they are consecutive in storage.
void appendRanges(const CellGrid& grid, const BoundingBox& box, std::vector<CellRange>& ranges);

}  // namespace engine
