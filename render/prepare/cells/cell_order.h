// A counting sort of items, such as particles, by the cells of a grid that they lie in.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace render {

/// Largest number of cells of such a grid; chosen: they take 16 MB.
inline constexpr double kMostCellsToSort = 4e6;
/// Stands for the cell of an item that is left out.
inline constexpr std::uint32_t kNoCell = 0xffffffffU;

/// Items one cell after another; those of one cell keep their order.
struct CellOrder {
    std::vector<std::uint32_t> begin;  ///< position in `items` of each cell's first item; at last the number of items
    std::vector<std::uint32_t> items;  ///< indices of the items
};

/// @param cells  index of the cell of each item, or kNoCell
inline CellOrder orderByCell(std::span<const std::uint32_t> cells, std::size_t cellCount) {
    CellOrder order;
    order.begin.assign(cellCount + 1, 0);
    for (const std::uint32_t cell : cells)
        if (cell != kNoCell) ++order.begin[cell + 1];
    for (std::size_t k = 1; k < order.begin.size(); ++k) order.begin[k] += order.begin[k - 1];
    order.items.resize(order.begin.back());
    std::vector<std::uint32_t> next(order.begin.begin(), order.begin.end() - 1);
    for (std::size_t k = 0; k < cells.size(); ++k)
        if (cells[k] != kNoCell) order.items[next[cells[k]]++] = static_cast<std::uint32_t>(k);
    return order;
}

}  // namespace render
