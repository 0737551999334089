// The light is a camera in parallel projection. A ray is cast for each texel, and three more where an outline runs
// between texels, because the edge of its shadow would be jagged otherwise.
#include "render/cpu/lighting/depth_map.h"

#include <algorithm>
#include <array>
#include <limits>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "render/cpu/metaballs/metaball_cast.h"
#include "render/cpu/metaballs/metaball_scene.h"
#include "render/cpu/metaballs/ray_layout.h"
#include "render/prepare/drawn_spheres.h"

namespace render {

namespace {

CameraFrame lightFrame(const LightBasis& basis, const DepthMap& map, float top) {
    CameraFrame frame;
    frame.perspective = false;
    frame.right = basis.u;
    frame.up = -basis.v;  // the rows of the map run along +v, from top to bottom
    frame.forward = -basis.toLight;
    frame.width = map.columns;
    frame.height = map.rows;
    frame.halfWidth = 0.5F * static_cast<float>(map.columns) * map.texelSize;
    frame.halfHeight = 0.5F * static_cast<float>(map.rows) * map.texelSize;
    frame.eye =
        (map.origin.x + frame.halfWidth) * basis.u + (map.origin.y + frame.halfHeight) * basis.v + top * basis.toLight;
    return frame;
}

// Texels per radius of the smallest particle in a map for sharp shadows. Chosen by eye: the edge of a shadow, which is
// filtered over three texels, is then a quarter of a radius wide.
constexpr float kTexelsPerRadius = 12.0F;

// Neighboring texels have an outline between them if their heights differ by more than this many texel sizes. With half
// as many, pictures come no nearer to the exact ones (measured).
constexpr float kJump = 4.0F;

constexpr std::size_t kReadAtOnce = 8;  // number of heights that light_visibility.cpp loads at once
constexpr float kMaxSteps = 65535.0F;   // largest height that can be stored, in steps of the map

/// A depth map without heights. Texels lie at multiples of their size in the world, so that they do not move when the
/// map grows by a row or the camera moves.
/// @param eye  position of the camera in light space, m
DepthMap emptyMap(const Bounds<glm::vec3>& bounds, glm::vec3 eye, float texelSize, int maxTexels) {
    DepthMap map;
    const glm::vec3 extent = bounds.high - bounds.low;
    map.texelSize = std::max(std::max(extent.x, extent.y) / static_cast<float>(maxTexels - 7), texelSize);
    // The map has a margin of three texels, because the filter reads neighbors of a texel.
    map.columns = static_cast<int>(extent.x / map.texelSize) + 8;
    map.rows = static_cast<int>(extent.y / map.texelSize) + 8;
    const glm::vec2 low = glm::vec2(bounds.low) + glm::vec2(eye);
    map.origin = (glm::floor(low / map.texelSize) - 3.0F) * map.texelSize - glm::vec2(eye);
    const auto texels = static_cast<std::size_t>(map.columns) * static_cast<std::size_t>(map.rows);
    map.bottom = bounds.low.z;
    map.step = std::max(extent.z / (kMaxSteps - 1.0F), std::numeric_limits<float>::min());
    map.heights.assign(4 * texels + kReadAtOnce, 0);
    map.lowest.assign(texels, 0.0F);
    map.highest.assign(texels, 0.0F);
    return map;
}

/// Casts the heights of an empty depth map and finds their bounds.
class HeightCast {
 public:
    /// @param top  height of the plane where the light's rays start, m
    HeightCast(const MetaballScene& scene, float top, DepthMap& map)
        : scene_(scene),
          top_(top),
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
        block.minDepth[block.count] = top_ - *highest - scene_.smallestRadius;
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
        return block.depth[k] < 0.0F ? kNoHeight : top_ - block.depth[k];
    }

    const MetaballScene& scene_;
    float top_;
    DepthMap& map_;
    std::size_t columns_, rows_;
    std::vector<float> first_;  // first of the four heights of each texel, m
};

}  // namespace

DepthMap castDepthMap(const LightBasis& basis, const View& view, std::span<const SkinBall> balls,
                      const DepthMapSampling& sampling) {
    Bounds<glm::vec3> bounds;  // bounds of the balls' kernels in light space, m
    float smallest = std::numeric_limits<float>::max();
    for (std::size_t k = 0; k < balls.size(); ++k) {
        const float radius = view.particles[k].radius;
        if (radius <= 0.0F) continue;
        const glm::vec3 center = basis.toLightSpace(balls[k].center - view.camera.eye);
        bounds.add(center - balls[k].reach, center + balls[k].reach);
        smallest = std::min(smallest, radius);
    }
    if (bounds.low.x > bounds.high.x) return {};
    // A soft edge is filtered over three texels, each half as wide as the softness (shading_model.h).
    const auto mean = static_cast<float>(meanRadius(view.particles));
    const float softness = view.light.softness;
    const float texelSize = softness > 0.0F ? 0.5F * softness * mean : smallest / kTexelsPerRadius;
    DepthMap map = emptyMap(bounds, basis.toLightSpace(view.camera.eye), texelSize, sampling.maxTexels);
    map.origin += sampling.shift * map.texelSize;
    CameraFrame frame = lightFrame(basis, map, bounds.high.z);
    frame.eye += view.camera.eye;
    HeightCast(metaballScene(frame, view, balls), bounds.high.z, map).run();
    return map;
}

}  // namespace render
