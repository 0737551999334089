// Which cell of a periodic grid a position is in.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "engine/core/vec3.h"
#include "engine/neighbors/cell_number.h"

namespace engine {

/// The index modulo the size, 0 or more.
inline std::int64_t wrapped(std::int64_t index, std::int64_t size) {
    const std::int64_t rest = index % size;
    return rest < 0 ? rest + size : rest;
}

/// The same of an index that is at most one size outside: divisions would take as long as the search of a cell.
inline std::int64_t wrappedStep(std::int64_t index, std::int64_t size) {
    if (index < 0) return index + size;
    return index < size ? index : index - size;
}

/// Cells along one axis. What has left every world, or is no number, shares a cell with others: the audit after the
/// step says what happened.
struct CellAxis {
    double width;         ///< m
    std::int64_t size;    ///< cells
    std::int64_t first;   ///< number of the first that is used
    std::int64_t stored;  ///< where that one is kept

    CellAxis(double cellWidth, std::int64_t cells, double lowest)
        : width(cellWidth), size(cells), first(cellNumber(lowest, width)), stored(wrapped(first, size)) {}

    std::int64_t cellOf(double coordinate) const {
        const std::int64_t number = cellNumber(coordinate, width);
        const std::int64_t steps = number - first;
        // Mostly there are as many cells as are needed, and a division takes as long as all the rest.
        if (steps < 0 || steps >= size) return wrapped(number, size);
        return wrappedStep(stored + steps, size);
    }
};

using CellAxes = std::array<CellAxis, 3>;

/// The cell of one position: x fastest. The plain twin of what follows.
inline std::uint32_t cellAt(const CellAxes& axes, const Vec3& position) {
    const std::int64_t x = axes[0].cellOf(position.x());
    const std::int64_t y = axes[1].cellOf(position.y());
    const std::int64_t z = axes[2].cellOf(position.z());
    return static_cast<std::uint32_t>((z * axes[1].size + y) * axes[0].size + x);
}

/// Writes the cell of each of some positions.
/// Holds:  equal to cellAt's on any instruction set.
void findCells(const CellAxes& axes, const Vec3* positions, std::size_t count, std::uint32_t* cells);

}  // namespace engine
