// Counting sort of items into cells: count, add up, fill. Called for the camera's tiles, the light's grid and the
// lines.
#include "render/tiles.h"

#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "render/system_error.h"

namespace render {

namespace {

// Bits of a float in an order that compares like the float.
std::uint32_t sortable(float key) {
    const auto bits = std::bit_cast<std::uint32_t>(key);
    return (bits & 0x80000000U) != 0 ? ~bits : bits | 0x80000000U;
}

struct KeyedPlace {
    std::uint32_t key;
    std::uint32_t place;
};

constexpr int kDigitBits = 11;
constexpr std::size_t kDigits = std::size_t{1} << kDigitBits;

void sortByDigit(const std::vector<KeyedPlace>& from, std::vector<KeyedPlace>& to, int shift) {
    std::array<std::uint32_t, kDigits + 1> start{};
    for (const KeyedPlace& item : from) ++start[((item.key >> shift) & (kDigits - 1)) + 1];
    for (std::size_t digit = 0; digit < kDigits; ++digit) start[digit + 1] += start[digit];
    for (const KeyedPlace& item : from) to[start[(item.key >> shift) & (kDigits - 1)]++] = item;
}

// How many items each cell has. An item adds to the corners of its cells, and sums along rows and columns do the rest,
// however many cells it has.
std::vector<std::uint32_t> itemCounts(std::span<const BinItem> items, const CellLists& lists) {
    const std::size_t across = static_cast<std::size_t>(lists.columns) + 1;
    // With a column and a row more, where what an item adds ends. Sums wrap around on the way, and come right.
    std::vector<std::uint32_t> steps(across * (static_cast<std::size_t>(lists.rows) + 1), 0);
    const auto at = [&](int column, int row) -> std::uint32_t& {
        return steps[static_cast<std::size_t>(row) * across + static_cast<std::size_t>(column)];
    };
    for (const BinItem& item : items) {
        const Rect& cells = item.cells;
        if (cells.x0 < 0 || cells.y0 < 0 || cells.x1 >= lists.columns || cells.y1 >= lists.rows ||
            cells.x1 < cells.x0 || cells.y1 < cells.y0)
            throw std::logic_error("render: an item in cells that are not there");
        ++at(cells.x0, cells.y0);
        --at(cells.x1 + 1, cells.y0);
        --at(cells.x0, cells.y1 + 1);
        ++at(cells.x1 + 1, cells.y1 + 1);
    }
    std::vector<std::uint32_t> counts;
    counts.reserve(static_cast<std::size_t>(lists.columns) * static_cast<std::size_t>(lists.rows));
    for (int row = 0; row < lists.rows; ++row) {
        std::uint32_t count = 0;
        for (int column = 0; column < lists.columns; ++column) {
            if (row > 0) at(column, row) += at(column, row - 1);
            count += at(column, row);
            counts.push_back(count);
        }
    }
    return counts;
}

// Writes the items to their cells. next: where each cell's first goes.
void fill(std::span<const BinItem> items, CellLists& lists, std::vector<std::uint32_t>& next) {
    // Bands of rows are independent of each other, so threads share neither counters nor lists. Each looks at all
    // items, so that there are only as many as threads need to share the work evenly.
    const int bands = 2 * tbb::this_task_arena::max_concurrency();
    tbb::parallel_for(0, bands, [&](int band) {
        const int top = lists.rows * band / bands;
        const int bottom = lists.rows * (band + 1) / bands - 1;
        for (const BinItem& item : items)
            for (int row = std::max(item.cells.y0, top); row <= std::min(item.cells.y1, bottom); ++row)
                for (int column = item.cells.x0; column <= item.cells.x1; ++column)
                    lists.items[next[lists.cellIndex(column, row)]++] = item.index;
    });
}

}  // namespace

std::vector<std::uint32_t> orderByKey(std::span<const float> keys) {
    std::vector<KeyedPlace> items(keys.size());
    for (std::size_t place = 0; place < keys.size(); ++place) {
        items[place] = {sortable(keys[place]), static_cast<std::uint32_t>(place)};
    }
    std::vector<KeyedPlace> other(keys.size());
    sortByDigit(items, other, 0);
    sortByDigit(other, items, kDigitBits);
    sortByDigit(items, other, 2 * kDigitBits);
    std::vector<std::uint32_t> order(keys.size());
    for (std::size_t place = 0; place < keys.size(); ++place) order[place] = other[place].place;
    return order;
}

CellLists binItems(std::span<const BinItem> items, int columns, int rows) {
    CellLists lists;
    lists.columns = columns;
    lists.rows = rows;
    const std::size_t cellCount = static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
    std::vector<std::uint32_t> next = itemCounts(items, lists);

    lists.begin.resize(cellCount + 1, 0);
    std::uint64_t total = 0;
    for (std::size_t cell = 0; cell < cellCount; ++cell) {
        lists.begin[cell] = static_cast<std::uint32_t>(total);
        total += next[cell];
        if (total > std::numeric_limits<std::int32_t>::max()) {
            throw SystemError(fmt::format("drawing {} items takes more than 2^31 list entries", items.size()));
        }
    }
    lists.begin[cellCount] = static_cast<std::uint32_t>(total);
    lists.items.resize(total);
    for (std::size_t cell = 0; cell < cellCount; ++cell) next[cell] = lists.begin[cell];
    fill(items, lists, next);
    return lists;
}

std::vector<Rect> touchedPixels(const CameraFrame& frame, std::span<const ViewSphere> spheres) {
    std::vector<Rect> pixels(spheres.size());
    constexpr std::size_t kChunk = 1024;
    tbb::parallel_for(std::size_t{0}, spheres.size() / kChunk + 1, [&](std::size_t chunk) {
        for (std::size_t k = chunk * kChunk; k < std::min((chunk + 1) * kChunk, spheres.size()); ++k)
            pixels[k] = pixelsTouched(frame, spheres[k].center, spheres[k].radius).value_or(Rect{});
    });
    return pixels;
}

CellLists binToTiles(const CameraFrame& frame, std::span<const ViewSphere> spheres, std::span<const Rect> pixels) {
    std::vector<float> nearest(spheres.size());
    for (std::size_t k = 0; k < spheres.size(); ++k) nearest[k] = spheres[k].center.z - spheres[k].radius;
    std::vector<BinItem> items;
    items.reserve(spheres.size());
    for (const std::uint32_t index : orderByKey(nearest)) {
        const Rect& at = pixels[index];
        if (at.x1 < at.x0) continue;
        items.push_back({index, {at.x0 / kTileSize, at.y0 / kTileSize, at.x1 / kTileSize, at.y1 / kTileSize}});
    }
    return binItems(items, (frame.width + kTileSize - 1) / kTileSize, (frame.height + kTileSize - 1) / kTileSize);
}

}  // namespace render
