// The light is a camera in parallel projection. A ray is cast for each texel, and three more where an outline runs
// between texels, because the edge of its shadow would be jagged otherwise.
#include "render/cpu/lighting/depth_map.h"

#include <algorithm>
#include <array>
#include <limits>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "render/cpu/metaballs/metaball_cast.h"
#include "render/cpu/metaballs/ray_layout.h"
#include "render/prepare/metaball_scene.h"

namespace render {

namespace {

// Neighboring texels have an outline between them if their heights differ by more than this many texel sizes. With half
// as many, pictures come no nearer to the exact ones (measured).
constexpr float kJump = 4.0F;

constexpr std::size_t kReadAtOnce = 8;  // number of heights that light_visibility.cpp loads at once
constexpr float kMaxSteps = 65535.0F;   // largest height that can be stored, in steps of the map

DepthMap emptyMap(const DepthMapGrid& grid) {
    DepthMap map{grid};
    const auto texels = static_cast<std::size_t>(map.columns) * static_cast<std::size_t>(map.rows);
    map.step = std::max((map.top - map.bottom) / (kMaxSteps - 1.0F), std::numeric_limits<float>::min());
    map.heights.assign(4 * texels + kReadAtOnce, 0);
    map.lowest.assign(texels, 0.0F);
    map.highest.assign(texels, 0.0F);
    return map;
}

/// Casts the heights of an empty depth map and finds their bounds.
class HeightCast {
 public:
    HeightCast(const MetaballScene& scene, DepthMap& map)
        : scene_(scene),
          map_(map),
          columns_(static_cast<std::size_t>(map.columns)),
          rows_(static_cast<std::size_t>(map.rows)),
          first_(columns_ * rows_, kNoHeight) {}

    void run() {
        forEachTile([&](std::size_t tile) { castFirst(tile); });
        forEachTile([&](std::size_t tile) { fillHeights(tile); });
        findBounds();
    }

 private:
    static constexpr float kNoHeight = -3e38F;

    /// Calls visit(tile) for the tiles that balls reach, in parallel.
    template <typename Visit>
    void forEachTile(const Visit& visit) const {
        tbb::parallel_for(std::size_t{0}, scene_.tiles.cellCount(), [&](std::size_t tile) {
            if (!scene_.tiles.itemsOf(tile).empty()) visit(tile);
        });
    }

    /// Casts the first of the four heights of each texel of a tile.
    void castFirst(std::size_t tile) {
        RayBlock block;
        placeRays(block, tileCorner(scene_.tiles, tile), kZCurve, glm::vec2(-0.25F));
        castBlock(scene_, tile, block);
        for (std::size_t k = 0; k < kTilePixels; ++k) {
            const auto column = static_cast<std::size_t>(block.x[k]);
            const auto row = static_cast<std::size_t>(block.y[k]);
            if (column < columns_ && row < rows_) first_[row * columns_ + column] = heightOf(block, k);
        }
    }

    /// Finds the other three heights of each texel of a tile. Each is the mean of the first heights around it if these
    /// differ little; otherwise a ray is cast for it.
    void fillHeights(std::size_t tile) {
        RayBlock block;
        block.count = 0;
        const glm::ivec2 corner(tileCorner(scene_.tiles, tile));
        for (const std::uint8_t pixel : kZCurve) {
            const auto column = static_cast<std::size_t>(corner.x + pixel % kTileSize);
            const auto row = static_cast<std::size_t>(corner.y + pixel / kTileSize);
            // The last column and the last row of the map are margin.
            if (column + 1 >= columns_ || row + 1 >= rows_) continue;
            const float* own = &first_[row * columns_ + column];
            const float* below = own + columns_;
            setHeight(2 * column, 2 * row, own[0]);
            fillBetween(2 * column + 1, 2 * row, std::array{own[0], own[1]}, block);
            fillBetween(2 * column, 2 * row + 1, std::array{own[0], below[0]}, block);
            fillBetween(2 * column + 1, 2 * row + 1, std::array{own[0], own[1], below[0], below[1]}, block);
            if (block.count + 3 > kTilePixels) castAdded(tile, block);
        }
        if (block.count > 0) castAdded(tile, block);
    }

    /// Sets a height to the mean of the heights around it or, where these differ much, adds its ray to the block.
    template <std::size_t kCount>
    void fillBetween(std::size_t column, std::size_t row, const std::array<float, kCount>& around, RayBlock& block) {
        const auto [lowest, highest] = std::minmax_element(around.begin(), around.end());
        if (*highest - *lowest <= kJump * map_.texelSize) {
            float mean = 0.0F;
            for (const float height : around) mean += height / static_cast<float>(kCount);
            setHeight(column, row, mean);
            return;
        }
        block.x[block.count] = 0.5F * static_cast<float>(column) + 0.25F;
        block.y[block.count] = 0.5F * static_cast<float>(row) + 0.25F;
        // The search begins one radius before the nearest surface around the ray.
        block.minDepth[block.count] = map_.top - *highest - scene_.smallestRadius;
        block.maxDepth[block.count] = kNoDepthLimit;
        ++block.count;
    }

    void castAdded(std::size_t tile, RayBlock& block) {
        castBlock(scene_, tile, block);
        for (std::size_t k = 0; k < block.count; ++k)
            setHeight(static_cast<std::size_t>(2.0F * block.x[k]), static_cast<std::size_t>(2.0F * block.y[k]),
                      heightOf(block, k));
        block.count = 0;
    }

    void setHeight(std::size_t column, std::size_t row, float height) {
        const float steps = (height - map_.bottom) / map_.step + 1.0F;
        map_.heights[row * 2 * columns_ + column] =
            static_cast<std::uint16_t>(std::clamp(steps, 0.0F, kMaxSteps) + 0.5F);
    }

    /// Finds the lowest and the highest height of each texel, then of five texels in a row, then of five such rows.
    void findBounds() {
        std::vector<float> lowest(map_.lowest.size()), highest(map_.highest.size());
        forEachRow(0, [&](std::size_t row) {
            const std::uint16_t* upper = &map_.heights[4 * row * columns_];
            const std::uint16_t* lower = upper + 2 * columns_;
            for (std::size_t k = 0; k < columns_; ++k) {
                const std::size_t right = 2 * k + 1;
                const std::size_t texel = row * columns_ + k;
                lowest[texel] = std::min({upper[right - 1], upper[right], lower[right - 1], lower[right]});
                highest[texel] = std::max({upper[right - 1], upper[right], lower[right - 1], lower[right]});
            }
        });
        std::vector<float> lowestInRow(lowest.size()), highestInRow(highest.size());
        const auto least = [](float a, float b) { return std::min(a, b); };
        const auto most = [](float a, float b) { return std::max(a, b); };
        forEachRow(0, [&](std::size_t row) {
            reduceFive(lowest, 1, row, least, lowestInRow);
            reduceFive(highest, 1, row, most, highestInRow);
        });
        forEachRow(2, [&](std::size_t row) {
            reduceFive(lowestInRow, columns_, row, least, map_.lowest);
            reduceFive(highestInRow, columns_, row, most, map_.highest);
        });
    }

    /// Calls visit(row) for all rows but `margin` at both ends, in parallel.
    template <typename Visit>
    void forEachRow(std::size_t margin, const Visit& visit) const {
        const tbb::blocked_range<std::size_t> rows(margin, rows_ - margin, 32);
        tbb::parallel_for(rows, [&](const auto& range) {
            for (std::size_t row = range.begin(); row < range.end(); ++row) visit(row);
        });
    }

    /// Reduces, for each texel of a row of the map, five values to one: its own and two on each side, `stride` apart.
    template <typename Reduce>
    void reduceFive(const std::vector<float>& from, std::size_t stride, std::size_t row, const Reduce& reduce,
                    std::vector<float>& to) const {
        for (std::size_t k = row * columns_ + 2; k < (row + 1) * columns_ - 2; ++k) {
            const float before = reduce(from[k - 2 * stride], from[k - stride]);
            const float after = reduce(from[k + stride], from[k + 2 * stride]);
            to[k] = reduce(from[k], reduce(before, after));
        }
    }

    float heightOf(const RayBlock& block, std::size_t k) const {
        return block.depth[k] < 0.0F ? kNoHeight : map_.top - block.depth[k];
    }

    const MetaballScene& scene_;
    DepthMap& map_;
    std::size_t columns_, rows_;
    std::vector<float> first_;  // first of the four heights of each texel, m
};

}  // namespace

DepthMap castDepthMap(const DepthMapGrid& grid, const MetaballScene& scene) {
    DepthMap map = emptyMap(grid);
    HeightCast(scene, map).run();
    return map;
}

}  // namespace render
