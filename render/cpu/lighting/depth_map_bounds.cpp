// Bounds of a depth map's heights around each texel, which tell most points that they are above or below all of them.
#include <algorithm>
#include <limits>
#include <utility>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "render/cpu/lighting/depth_map.h"

namespace render {

namespace {

constexpr std::size_t kReadAtOnce = 8;  // number of heights that light_visibility.cpp loads at once

/// Calls visit(row) for all rows but `margin` at both ends, in parallel.
template <typename Visit>
void forEachRow(const DepthMap& map, std::size_t margin, const Visit& visit) {
    const tbb::blocked_range<std::size_t> rows(margin, static_cast<std::size_t>(map.rows) - margin, 32);
    tbb::parallel_for(rows, [&](const auto& range) {
        for (std::size_t row = range.begin(); row < range.end(); ++row) visit(row);
    });
}

/// Reduces, for each texel of a row of the map, five values to one: its own and two on each side, `stride` apart.
template <typename Reduce>
void reduceFive(const std::vector<float>& from, std::size_t stride, std::size_t row, const Reduce& reduce,
                std::size_t columns, std::vector<float>& to) {
    for (std::size_t k = row * columns + 2; k < (row + 1) * columns - 2; ++k) {
        const float before = reduce(from[k - 2 * stride], from[k - stride]);
        const float after = reduce(from[k + stride], from[k + 2 * stride]);
        to[k] = reduce(from[k], reduce(before, after));
    }
}

}  // namespace

DepthMap emptyDepthMap(const DepthMapGrid& grid, DepthMap old) {
    DepthMap map = std::move(old);
    static_cast<DepthMapGrid&>(map) = grid;
    const auto texels = static_cast<std::size_t>(map.columns) * static_cast<std::size_t>(map.rows);
    map.step = std::max((map.top - map.bottom) / (kMostSteps - 1.0F), std::numeric_limits<float>::min());
    map.heights.assign(4 * texels + kReadAtOnce, 0);
    map.lowest.assign(texels, 0.0F);
    map.highest.assign(texels, 0.0F);
    return map;
}

void findHeightBounds(DepthMap& map) {
    const auto columns = static_cast<std::size_t>(map.columns);
    // The lowest and the highest height of each texel, then of five texels in a row, then of five such rows.
    std::vector<float> lowest(map.lowest.size()), highest(map.highest.size());
    forEachRow(map, 0, [&](std::size_t row) {
        const std::uint16_t* upper = &map.heights[4 * row * columns];
        const std::uint16_t* lower = upper + 2 * columns;
        for (std::size_t k = 0; k < columns; ++k) {
            const std::size_t right = 2 * k + 1;
            const std::size_t texel = row * columns + k;
            lowest[texel] = std::min({upper[right - 1], upper[right], lower[right - 1], lower[right]});
            highest[texel] = std::max({upper[right - 1], upper[right], lower[right - 1], lower[right]});
        }
    });
    std::vector<float> lowestInRow(lowest.size()), highestInRow(highest.size());
    const auto least = [](float a, float b) { return std::min(a, b); };
    const auto most = [](float a, float b) { return std::max(a, b); };
    forEachRow(map, 0, [&](std::size_t row) {
        reduceFive(lowest, 1, row, least, columns, lowestInRow);
        reduceFive(highest, 1, row, most, columns, highestInRow);
    });
    forEachRow(map, 2, [&](std::size_t row) {
        reduceFive(lowestInRow, columns, row, least, columns, map.lowest);
        reduceFive(highestInRow, columns, row, most, columns, map.highest);
    });
}

}  // namespace render
