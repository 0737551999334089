// Bounds of a depth map's heights around each texel, which tell most points that they are above or below all of them.
#include <algorithm>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "render/cpu/lighting/depth_map.h"

namespace render {

namespace {

constexpr std::size_t kReadAtOnce = 8;  // number of heights that light_visibility.cpp loads at once

constexpr std::size_t kTexelRows = 32;  // rows of texels that one task handles; chosen

/// The least and the greatest heights of texels, row by row.
struct Extremes {
    std::vector<float> lowest, highest;

    void resize(std::size_t count) {
        lowest.resize(count);
        highest.resize(count);
    }
};

/// Finds the lowest and the highest of the four heights of each texel of a row.
void findOfTexels(const DepthMap& map, std::size_t row, Extremes& texels) {
    const auto columns = static_cast<std::size_t>(map.columns);
    const std::uint16_t* upper = &map.heights[4 * row * columns];
    const std::uint16_t* lower = upper + 2 * columns;
    for (std::size_t k = 0; k < columns; ++k) {
        const std::size_t right = 2 * k + 1;
        texels.lowest[k] = std::min({upper[right - 1], upper[right], lower[right - 1], lower[right]});
        texels.highest[k] = std::max({upper[right - 1], upper[right], lower[right - 1], lower[right]});
    }
}

/// Reduces five values to one, for each k from 2 to columns - 3: its own and two on each side, `stride` apart.
template <typename Reduce>
void reduceFive(const float* from, std::size_t stride, std::size_t columns, const Reduce& reduce, float* to) {
    for (std::size_t k = 2; k + 2 < columns; ++k) {
        const float* own = from + k;
        const float before = reduce(*(own - 2 * stride), *(own - stride));
        const float after = reduce(own[stride], own[2 * stride]);
        to[k] = reduce(*own, reduce(before, after));
    }
}

/// Finds the bounds of the rows from `first` to `end`: of five texels in a row, then of five such rows.
void findOfBand(DepthMap& map, std::size_t first, std::size_t end) {
    const auto columns = static_cast<std::size_t>(map.columns);
    const auto least = [](float a, float b) { return std::min(a, b); };
    const auto most = [](float a, float b) { return std::max(a, b); };
    thread_local Extremes texels, inRows;
    texels.resize(columns);
    inRows.resize((end - first + 4) * columns);
    for (std::size_t row = first - 2; row < end + 2; ++row) {
        findOfTexels(map, row, texels);
        const std::size_t at = (row + 2 - first) * columns;
        reduceFive(texels.lowest.data(), 1, columns, least, &inRows.lowest[at]);
        reduceFive(texels.highest.data(), 1, columns, most, &inRows.highest[at]);
    }
    for (std::size_t row = first; row < end; ++row) {
        const std::size_t at = (row + 2 - first) * columns;
        reduceFive(&inRows.lowest[at], columns, columns, least, &map.lowest[row * columns]);
        reduceFive(&inRows.highest[at], columns, columns, most, &map.highest[row * columns]);
    }
}

}  // namespace

DepthMap sizedDepthMap(const DepthMapGrid& grid, DepthMap old) {
    DepthMap map = std::move(old);
    static_cast<DepthMapGrid&>(map) = grid;
    const auto texels = static_cast<std::size_t>(map.columns) * static_cast<std::size_t>(map.rows);
    map.step = std::max((map.top - map.bottom) / (kMostSteps - 1.0F), std::numeric_limits<float>::min());
    map.heights.resize(4 * texels + kReadAtOnce);
    map.lowest.resize(texels);
    map.highest.resize(texels);
    return map;
}

void findHeightBounds(DepthMap& map) {
    const tbb::blocked_range<std::size_t> rows(2, static_cast<std::size_t>(map.rows) - 2, kTexelRows);
    tbb::parallel_for(rows, [&](const auto& range) { findOfBand(map, range.begin(), range.end()); });
}

}  // namespace render
