// The light is a camera in parallel projection. A ray is cast for each texel, and three more where an outline runs
// between texels, because the edge of its shadow would be jagged otherwise.
#include "render/cpu/lighting/depth_map.h"

#include <algorithm>
#include <array>
#include <limits>

#include <tbb/parallel_for.h>

#include "render/cpu/metaballs/metaball_cast.h"
#include "render/cpu/metaballs/ray_layout.h"
#include "render/prepare/metaball_scene.h"

namespace render {

namespace {

// Neighboring texels have an outline between them if their heights differ by more than this many texel sizes. With half
// as many, pictures come no nearer to the exact ones (measured).
constexpr float kJump = 4.0F;

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
        findHeightBounds(map_);
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
        map_.heights[row * 2 * columns_ + column] =
            static_cast<std::uint16_t>(std::clamp(map_.stepsOf(height), 0.0F, kMostSteps) + 0.5F);
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
    DepthMap map = sizedDepthMap(grid);
    HeightCast(scene, map).run();
    return map;
}

}  // namespace render
