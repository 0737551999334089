// The light as a camera in parallel projection: a ray for each texel, and more where an outline runs between them,
// whose shadow would have steps else.
#include "render/cpu/lighting/depth_map.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "render/cpu/metaballs/ray_layout.h"

namespace render {

namespace {

CameraFrame lightFrame(const LightBasis& basis, const DepthMap& map, float top) {
    CameraFrame frame;
    frame.perspective = false;
    frame.right = basis.u;
    frame.up = -basis.v;  // rows of the map run along +v
    frame.forward = -basis.toLight;
    frame.width = map.columns;
    frame.height = map.rows;
    frame.halfWidth = 0.5F * static_cast<float>(map.columns) * map.texelSize;
    frame.halfHeight = 0.5F * static_cast<float>(map.rows) * map.texelSize;
    frame.eye =
        (map.origin.x + frame.halfWidth) * basis.u + (map.origin.y + frame.halfHeight) * basis.v + top * basis.toLight;
    return frame;
}

// A hard shadow's edge is three texels wide, softened for the eye alone.
constexpr float kTexelsPerRadius = 12.0F;

// From one texel to the next, in texels: what rises by more is taken for an outline. At half of it pictures are no
// nearer to the exact ones (measured).
constexpr float kJump = 4.0F;

constexpr std::size_t kReadAtOnce = 8;  // heights
constexpr float kMostSteps = 65535.0F;

// eye: of the camera in light space. Texels lie at multiples of their size in the world, so that a map that grows by a
// row, or a camera that moves, leaves the rest where it was.
DepthMap emptyMap(const LightBounds& bounds, glm::vec3 eye, float texelSize, int mostTexels) {
    DepthMap map;
    const glm::vec3 extent = bounds.high - bounds.low;
    map.texelSize = std::max(std::max(extent.x, extent.y) / static_cast<float>(mostTexels - 7), texelSize);
    // Three texels of margin for the filter.
    map.columns = static_cast<int>(extent.x / map.texelSize) + 8;
    map.rows = static_cast<int>(extent.y / map.texelSize) + 8;
    const glm::vec2 low = glm::vec2(bounds.low) + glm::vec2(eye);
    map.origin = (glm::floor(low / map.texelSize) - 3.0F) * map.texelSize - glm::vec2(eye);
    const auto texels = static_cast<std::size_t>(map.columns) * static_cast<std::size_t>(map.rows);
    map.bottom = bounds.low.z;
    map.step = std::max(extent.z / (kMostSteps - 1.0F), std::numeric_limits<float>::min());
    map.heights.assign(4 * texels + kReadAtOnce, 0);
    map.lowest.assign(texels, 0.0F);
    map.highest.assign(texels, 0.0F);
    return map;
}

/// The map on its way.
class Heights {
 public:
    /// top: of the surface, where the light's rays start.
    Heights(const FieldCast& cast, const BinnedField& field, float top, DepthMap& map)
        : cast_(cast),
          field_(field),
          top_(top),
          map_(map),
          columns_(static_cast<std::size_t>(map.columns)),
          rows_(static_cast<std::size_t>(map.rows)),
          first_(columns_ * rows_, kNoHeight) {}

    void find() {
        forTiles([&](std::size_t tile) { castFirst(tile); });
        forTiles([&](std::size_t tile) { findBetween(tile); });
        findBounds();
    }

 private:
    static constexpr float kNoHeight = -3e38F;

    /// visit(tile) for those that balls reach, by all threads.
    template <typename Visit>
    void forTiles(const Visit& visit) const {
        tbb::parallel_for(std::size_t{0}, field_.tiles.begin.size() - 1, [&](std::size_t tile) {
            if (field_.tiles.begin[tile + 1] > field_.tiles.begin[tile]) visit(tile);
        });
    }

    void castFirst(std::size_t tile) {
        RayBlock block;
        placeRays(block, tileCorner(field_.tiles, tile), kZCurve, glm::vec2(-0.25F));
        castBlock(cast_, tile, block);
        for (std::size_t k = 0; k < kBlockRays; ++k) {
            const auto column = static_cast<std::size_t>(block.x[k]);
            const auto row = static_cast<std::size_t>(block.y[k]);
            if (column < columns_ && row < rows_) first_[row * columns_ + column] = heightOf(block, k);
        }
    }

    /// All heights of a tile: between first ones that are near each other their mean, others are cast.
    void findBetween(std::size_t tile) {
        RayBlock block;
        block.count = 0;
        const glm::ivec2 corner(tileCorner(field_.tiles, tile));
        for (const std::uint8_t place : kZCurve) {
            const auto column = static_cast<std::size_t>(corner.x + place % kTileSize);
            const auto row = static_cast<std::size_t>(corner.y + place / kTileSize);
            // Nothing is seen in the last column and row.
            if (column + 1 >= columns_ || row + 1 >= rows_) continue;
            const float* own = &first_[row * columns_ + column];
            const float* below = own + columns_;
            put(2 * column, 2 * row, own[0]);
            putBetween(2 * column + 1, 2 * row, std::array{own[0], own[1]}, block);
            putBetween(2 * column, 2 * row + 1, std::array{own[0], below[0]}, block);
            putBetween(2 * column + 1, 2 * row + 1, std::array{own[0], own[1], below[0], below[1]}, block);
            if (block.count + 3 > kBlockRays) putCast(tile, block);
        }
        if (block.count > 0) putCast(tile, block);
    }

    template <std::size_t kCount>
    void putBetween(std::size_t column, std::size_t row, const std::array<float, kCount>& around, RayBlock& block) {
        const auto [lowest, highest] = std::minmax_element(around.begin(), around.end());
        if (*highest - *lowest <= kJump * map_.texelSize) {
            float mean = 0.0F;
            for (const float height : around) mean += height / static_cast<float>(kCount);
            put(column, row, mean);
            return;
        }
        block.x[block.count] = 0.5F * static_cast<float>(column) + 0.25F;
        block.y[block.count] = 0.5F * static_cast<float>(row) + 0.25F;
        // From a radius before the nearest around.
        block.from[block.count] = top_ - *highest - field_.smallestRadius;
        block.to[block.count] = kEndless;
        ++block.count;
    }

    void putCast(std::size_t tile, RayBlock& block) {
        castBlock(cast_, tile, block);
        for (std::size_t k = 0; k < block.count; ++k)
            put(static_cast<std::size_t>(2.0F * block.x[k]), static_cast<std::size_t>(2.0F * block.y[k]),
                heightOf(block, k));
        block.count = 0;
    }

    void put(std::size_t column, std::size_t row, float height) {
        const float steps = (height - map_.bottom) / map_.step + 1.0F;
        map_.heights[row * 2 * columns_ + column] =
            static_cast<std::uint16_t>(std::clamp(steps, 0.0F, kMostSteps) + 0.5F);
    }

    /// Of each texel, then of five in a row, then of five such in a column.
    void findBounds() {
        std::vector<float> lowest(map_.lowest.size()), highest(map_.highest.size());
        forRows(0, [&](std::size_t row) {
            const std::uint16_t* upper = &map_.heights[4 * row * columns_];
            const std::uint16_t* lower = upper + 2 * columns_;
            for (std::size_t k = 0; k < columns_; ++k) {
                const std::size_t next = 2 * k + 1;
                const std::size_t texel = row * columns_ + k;
                lowest[texel] = std::min({upper[next - 1], upper[next], lower[next - 1], lower[next]});
                highest[texel] = std::max({upper[next - 1], upper[next], lower[next - 1], lower[next]});
            }
        });
        std::vector<float> lowestInRow(lowest.size()), highestInRow(highest.size());
        const auto least = [](float a, float b) { return std::min(a, b); };
        const auto most = [](float a, float b) { return std::max(a, b); };
        forRows(0, [&](std::size_t row) {
            ofFive(lowest, 1, row, least, lowestInRow);
            ofFive(highest, 1, row, most, highestInRow);
        });
        forRows(2, [&](std::size_t row) {
            ofFive(lowestInRow, columns_, row, least, map_.lowest);
            ofFive(highestInRow, columns_, row, most, map_.highest);
        });
    }

    /// visit(row) for all but so many at both ends, by all threads.
    template <typename Visit>
    void forRows(std::size_t margin, const Visit& visit) const {
        const tbb::blocked_range<std::size_t> rows(margin, rows_ - margin, 32);
        tbb::parallel_for(rows, [&](const auto& range) {
            for (std::size_t row = range.begin(); row < range.end(); ++row) visit(row);
        });
    }

    /// Chooses among a texel of a row and two on each side of it, so far apart.
    template <typename Choose>
    void ofFive(const std::vector<float>& from, std::size_t apart, std::size_t row, const Choose& choose,
                std::vector<float>& to) const {
        for (std::size_t k = row * columns_ + 2; k < (row + 1) * columns_ - 2; ++k) {
            const float before = choose(from[k - 2 * apart], from[k - apart]);
            const float after = choose(from[k + apart], from[k + 2 * apart]);
            to[k] = choose(from[k], choose(before, after));
        }
    }

    float heightOf(const RayBlock& block, std::size_t k) const {
        return block.depth[k] < 0.0F ? kNoHeight : top_ - block.depth[k];
    }

    const FieldCast& cast_;
    const BinnedField& field_;
    float top_;
    DepthMap& map_;
    std::size_t columns_, rows_;
    std::vector<float> first_;  // heights, one a texel
};

}  // namespace

DepthMap castDepthMap(const LightBasis& basis, const Skinned& skin, const DepthMapSampling& sampling) {
    const View& view = skin.view;
    DepthMap map;
    std::vector<ViewSphere> reaches;
    float smallest = std::numeric_limits<float>::max();
    double sum = 0.0;
    for (std::size_t k = 0; k < skin.balls.size(); ++k) {
        const float radius = view.particles[k].radius;
        if (radius <= 0.0F) continue;
        reaches.push_back({skin.balls[k].center - view.camera.eye, view.field.reach * radius});
        smallest = std::min(smallest, radius);
        sum += double(radius);
    }
    if (reaches.empty()) return map;
    const LightBounds bounds = lightBounds(basis, reaches);
    // A soft edge is three texels of half the softness wide.
    const auto mean = static_cast<float>(sum / static_cast<double>(reaches.size()));
    const float soft = view.light.softness;
    map = emptyMap(bounds, basis.toLightSpace(view.camera.eye),
                   soft > 0.0F ? 0.5F * soft * mean : smallest / kTexelsPerRadius, sampling.mostTexels);
    map.origin += sampling.shift * map.texelSize;
    CameraFrame frame = lightFrame(basis, map, bounds.high.z);
    frame.eye += view.camera.eye;

    const BinnedField field = binField(frame, skin);
    const FieldCast cast = fieldCast(frame, view, field);
    Heights(cast, field, bounds.high.z, map).find();
    return map;
}

}  // namespace render
