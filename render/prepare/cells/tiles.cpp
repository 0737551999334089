// A counting sort of items into cells: count, sum up, fill. Items are ordered before by a radix sort of their keys.
#include "render/prepare/cells/tiles.h"

#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <numeric>
#include <stdexcept>

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "render/picture/system_error.h"

namespace render {

namespace {

/// Maps a float to an integer such that integers compare like the floats do.
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
constexpr std::size_t kDigitBits = 11;
constexpr std::size_t kDigits = std::size_t{1} << kDigitBits;
constexpr std::size_t kPasses = 3;

std::size_t digitOf(std::uint32_t key, std::size_t pass) {
    return (key >> (pass * kDigitBits)) & (kDigits - 1);
}

/// How many keys have each digit, for each pass.
using DigitCounts = std::array<std::array<std::uint32_t, kDigits>, kPasses>;

/// Calls put(place, item) for each item with its place in the order of a pass.
/// @param counts  of the digits of this pass; overwritten
template <typename Put>
void sortByDigit(std::span<const KeyedIndex> items, std::size_t pass, DigitCounts& counts, const Put& put) {
    std::array<std::uint32_t, kDigits>& next = counts[pass];
    std::exclusive_scan(next.begin(), next.end(), next.begin(), 0U);
    for (const KeyedIndex& item : items) put(next[digitOf(item.key, pass)]++, item);
}

/// Calls visit(cell index) for every cell of an item, row by row.
template <typename Visit>
void forCells(const CellLists& lists, const Rect& cells, const Visit& visit) {
    for (int row = cells.y0; row <= cells.y1; ++row) {
        const std::size_t last = lists.cellIndex(cells.x1, row);
        for (std::size_t cell = lists.cellIndex(cells.x0, row); cell <= last; ++cell) visit(cell);
    }
}

}  // namespace

std::vector<std::uint32_t> indicesByKey(std::span<const float> keys) {
    std::vector<KeyedIndex> items(keys.size());
    DigitCounts counts{};
    for (std::size_t k = 0; k < keys.size(); ++k) {
        items[k] = {sortable(keys[k]), static_cast<std::uint32_t>(k)};
        for (std::size_t pass = 0; pass < kPasses; ++pass) ++counts[pass][digitOf(items[k].key, pass)];
    }
    std::vector<KeyedIndex> other(keys.size());
    sortByDigit(items, 0, counts, [&](std::uint32_t place, const KeyedIndex& item) { other[place] = item; });
    sortByDigit(other, 1, counts, [&](std::uint32_t place, const KeyedIndex& item) { items[place] = item; });
    std::vector<std::uint32_t> order(keys.size());
    sortByDigit(items, 2, counts, [&](std::uint32_t place, const KeyedIndex& item) { order[place] = item.index; });
    return order;
}

CellLists binIntoCells(std::span<const CellItem> items, int columns, int rows) {
    CellLists lists;
    lists.columns = columns;
    lists.rows = rows;
    lists.begin.assign(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows) + 1, 0);
    std::uint64_t total = 0;
    for (const auto& [index, cells] : items) {
        if (cells.x0 < 0 || cells.y0 < 0 || cells.x1 >= columns || cells.y1 >= rows || cells.x1 < cells.x0 ||
            cells.y1 < cells.y0)
            throw std::logic_error("render: an item lies outside of the grid of cells");
        total +=
            static_cast<std::uint64_t>(cells.x1 - cells.x0 + 1) * static_cast<std::uint64_t>(cells.y1 - cells.y0 + 1);
        if (total > std::numeric_limits<std::int32_t>::max())
            throw SystemError(fmt::format("drawing {} items takes more than 2^31 list entries", items.size()));
        forCells(lists, cells, [&](std::size_t cell) { ++lists.begin[cell + 1]; });
    }
    std::partial_sum(lists.begin.begin(), lists.begin.end(), lists.begin.begin());
    lists.items.resize(total);
    std::vector<std::uint32_t> end = lists.begin;  // end of each cell's list so far
    for (const auto& [index, cells] : items)
        forCells(lists, cells, [&, index = index](std::size_t cell) { lists.items[end[cell]++] = index; });
    return lists;
}

std::vector<Rect> pixelBounds(const CameraFrame& frame, std::span<const ViewSphere> spheres) {
    std::vector<Rect> pixels(spheres.size());
    constexpr std::size_t kChunk = 1024;
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, spheres.size(), kChunk), [&](const auto& range) {
        for (std::size_t k = range.begin(); k < range.end(); ++k)
            pixels[k] = pixelsTouchedBySphere(frame, spheres[k].center, spheres[k].radius).value_or(Rect{});
    });
    return pixels;
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
    return binIntoCells(items, tilesAlong(frame.width), tilesAlong(frame.height));
}

}  // namespace render
