// A counting sort of items into the rows of the grid, then one of each row's items into its cells. Items that cover
// several rows or columns are counted by differences: +1 where they begin, -1 after their end, summed up along the
// grid.
#include "render/prepare/tiles.h"

#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include "render/picture/system_error.h"

namespace render {

namespace {

/// The bits of a float, mapped so that they compare as integers like the floats do.
std::uint32_t sortable(float key) {
    const auto bits = std::bit_cast<std::uint32_t>(key);
    return (bits & 0x80000000U) != 0 ? ~bits : bits | 0x80000000U;
}

struct KeyedIndex {
    std::uint32_t key;
    std::uint32_t index;
};

// A radix sort in three passes over digits of 11 bits, the lowest digit first. Each pass keeps the order of equal
// digits.
constexpr int kDigitBits = 11;
constexpr std::size_t kDigits = std::size_t{1} << kDigitBits;

void sortByDigit(const std::vector<KeyedIndex>& from, std::vector<KeyedIndex>& to, int shift) {
    std::array<std::uint32_t, kDigits + 1> start{};
    for (const KeyedIndex& item : from) ++start[((item.key >> shift) & (kDigits - 1)) + 1];
    for (std::size_t digit = 0; digit < kDigits; ++digit) start[digit + 1] += start[digit];
    for (const KeyedIndex& item : from) to[start[(item.key >> shift) & (kDigits - 1)]++] = item;
}

/// The columns that an item covers in one row of cells.
struct RowItem {
    std::uint32_t index;
    std::int32_t first, last;  ///< column
};

/// The items of each row in their given order, one row after another.
struct RowLists {
    std::vector<std::size_t> begin;  ///< rows + 1 entries
    std::vector<RowItem> items;

    std::span<const RowItem> of(std::size_t row) const {
        return std::span(items).subspan(begin[row], begin[row + 1] - begin[row]);
    }
};

RowLists rowLists(std::span<const CellItem> items, int columns, int rows) {
    RowLists lists;
    std::vector<std::size_t> next(static_cast<std::size_t>(rows) + 1, 0);
    for (const CellItem& item : items) {
        const Rect& cells = item.cells;
        if (cells.x0 < 0 || cells.y0 < 0 || cells.x1 >= columns || cells.y1 >= rows || cells.x1 < cells.x0 ||
            cells.y1 < cells.y0)
            throw std::logic_error("render: an item lies outside of the grid of cells");
        ++next[static_cast<std::size_t>(cells.y0)];
        --next[static_cast<std::size_t>(cells.y1) + 1];
    }
    std::partial_sum(next.begin(), next.end(), next.begin());
    lists.begin.resize(next.size());
    std::exclusive_scan(next.begin(), next.end(), lists.begin.begin(), std::size_t{0});
    lists.items.resize(lists.begin.back());
    next = lists.begin;
    for (const CellItem& item : items)
        for (int row = item.cells.y0; row <= item.cells.y1; ++row)
            lists.items[next[static_cast<std::size_t>(row)]++] = {item.index, item.cells.x0, item.cells.x1};
    return lists;
}

/// The number of items in each cell of a row.
void countPerCell(std::span<const RowItem> items, std::span<std::uint32_t> cells) {
    // Differences below 0 wrap around; the sums are right again.
    for (const RowItem& item : items) {
        ++cells[static_cast<std::size_t>(item.first)];
        const auto end = static_cast<std::size_t>(item.last) + 1;
        if (end < cells.size()) --cells[end];
    }
    std::partial_sum(cells.begin(), cells.end(), cells.begin());
}

}  // namespace

std::vector<std::uint32_t> indicesByKey(std::span<const float> keys) {
    std::vector<KeyedIndex> items(keys.size());
    for (std::size_t k = 0; k < keys.size(); ++k) items[k] = {sortable(keys[k]), static_cast<std::uint32_t>(k)};
    std::vector<KeyedIndex> other(keys.size());
    sortByDigit(items, other, 0);
    sortByDigit(other, items, kDigitBits);
    sortByDigit(items, other, 2 * kDigitBits);
    std::vector<std::uint32_t> order(keys.size());
    for (std::size_t k = 0; k < keys.size(); ++k) order[k] = other[k].index;
    return order;
}

CellLists binIntoCells(std::span<const CellItem> items, int columns, int rows) {
    CellLists lists;
    lists.columns = columns;
    lists.rows = rows;
    const RowLists rowItems = rowLists(items, columns, rows);
    const auto across = static_cast<std::size_t>(columns);
    std::vector<std::uint32_t> next(across * static_cast<std::size_t>(rows), 0);
    const auto cellsOf = [&](std::size_t row) { return std::span(next).subspan(row * across, across); };
    // Rows are independent of each other: threads share neither counters nor lists.
    const auto forRows = [&](const auto& visit) {
        tbb::parallel_for(std::size_t{0}, static_cast<std::size_t>(rows), visit);
    };
    forRows([&](std::size_t row) { countPerCell(rowItems.of(row), cellsOf(row)); });

    lists.begin.reserve(next.size() + 1);
    std::uint64_t total = 0;
    for (std::uint32_t& cell : next) {
        lists.begin.push_back(static_cast<std::uint32_t>(total));
        total += std::exchange(cell, lists.begin.back());
        if (total > std::numeric_limits<std::int32_t>::max()) {
            throw SystemError(fmt::format("drawing {} items takes more than 2^31 list entries", items.size()));
        }
    }
    lists.begin.push_back(static_cast<std::uint32_t>(total));
    lists.items.resize(total);
    forRows([&](std::size_t row) {
        std::uint32_t* end = cellsOf(row).data();  // of each cell's list so far
        for (const RowItem& item : rowItems.of(row))
            for (std::int32_t column = item.first; column <= item.last; ++column)
                lists.items[end[column]++] = item.index;
    });
    return lists;
}

CellLists binToTiles(const CameraFrame& frame, std::span<const ViewSphere> spheres, std::span<const Rect> pixels) {
    std::vector<float> nearest(spheres.size());
    for (std::size_t k = 0; k < spheres.size(); ++k) nearest[k] = spheres[k].center.z - spheres[k].radius;
    std::vector<CellItem> items;
    items.reserve(spheres.size());
    for (const std::uint32_t index : indicesByKey(nearest)) {
        const Rect& at = pixels[index];
        if (at.x1 < at.x0) continue;
        items.push_back({index, {at.x0 / kTileSize, at.y0 / kTileSize, at.x1 / kTileSize, at.y1 / kTileSize}});
    }
    return binIntoCells(items, (frame.width + kTileSize - 1) / kTileSize, (frame.height + kTileSize - 1) / kTileSize);
}

}  // namespace render
