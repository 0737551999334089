// The rows of heights are divided into bands, of which each is drawn by one thread. A height is the greatest of all
// triangles over it, so that their order does not matter.
#include "render/cpu/lighting/mesh_depth_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "render/prepare/tiles.h"

namespace render {

namespace {

constexpr int kBandRows = 32;  // rows of heights in a band; chosen

// How far beyond its edges a triangle covers heights, in distances between heights: more than the rounding, so that no
// light falls between two triangles.
constexpr double kSlack = 1.0e-3;

/// The corners of a triangle: x and y count the columns and rows of heights, z is a height in steps of the map.
using Corners = std::array<glm::dvec3, 3>;

/// The columns of heights that a triangle covers in a row; none if last < first.
struct Span {
    int first = 0;
    int last = -1;
};

class MeshHeights {
 public:
    MeshHeights(const LightBasis& basis, const DrawnMeshes& meshes, DepthMap& map)
        : meshes_(meshes),
          map_(map),
          columns_(2 * map.columns),
          rows_(2 * map.rows),
          corners_(meshes.positions.size()) {
        const tbb::blocked_range<std::size_t> all(0, corners_.size(), 4096);
        tbb::parallel_for(all, [&](const auto& range) {
            for (std::size_t k = range.begin(); k < range.end(); ++k) {
                const glm::vec3 at = basis.toLightSpace(meshes.positions[k]);
                // The first height of a texel lies a quarter of the texel's side from its corner.
                const glm::vec2 place = (glm::vec2(at) - map.origin) * (2.0F / map.texelSize) - 0.5F;
                corners_[k] = {place, map.stepsOf(at.z)};
            }
        });
    }

    void drawAll() {
        const CellLists bands = listByBand();
        tbb::parallel_for(0, bands.rows, [&](int band) {
            const std::ptrdiff_t last = std::min((band + 1) * kBandRows, rows_);
            std::fill(map_.heights.begin() + std::ptrdiff_t{band} * kBandRows * columns_,
                      map_.heights.begin() + last * columns_, std::uint16_t{0});
            for (const std::uint32_t index : bands.itemsOf(static_cast<std::size_t>(band)))
                draw(cornersOf(index), band * kBandRows, std::min((band + 1) * kBandRows, rows_) - 1);
        });
    }

 private:
    Corners cornersOf(std::size_t triangle) const {
        const auto& [a, b, c] = meshes_.triangles[triangle].corners;
        return {glm::dvec3(corners_[a]), glm::dvec3(corners_[b]), glm::dvec3(corners_[c])};
    }

    /// Twice the area of a triangle on the light's plane; negative where it is turned away from the light.
    static double areaOf(const Corners& at) {
        const glm::dvec3 b = at[1] - at[0];
        const glm::dvec3 c = at[2] - at[0];
        return b.x * c.y - b.y * c.x;
    }

    CellLists listByBand() const {
        std::vector<CellItem> items;
        for (std::size_t k = 0; k < meshes_.triangles.size(); ++k) {
            const Corners at = cornersOf(k);
            if (!(areaOf(at) < 0.0)) continue;
            const int low =
                std::clamp(static_cast<int>(std::ceil(std::min({at[0].y, at[1].y, at[2].y}))), 0, rows_ - 1);
            const int high = std::clamp(static_cast<int>(std::max({at[0].y, at[1].y, at[2].y})), 0, rows_ - 1);
            if (high < low) continue;
            items.push_back({static_cast<std::uint32_t>(k), {0, low / kBandRows, 0, high / kBandRows}});
        }
        return binIntoCells(items, 1, (rows_ + kBandRows - 1) / kBandRows);
    }

    /// The columns between the edges of a triangle that cross a row. An edge crosses it at the same place in both of
    /// its triangles, up to the rounding.
    /// @param slopes  of the edges, in columns a row
    Span spanOf(const Corners& at, const std::array<double, 3>& slopes, double row) const {
        double low = std::numeric_limits<double>::max();
        double high = std::numeric_limits<double>::lowest();
        const auto add = [&](double x) {
            low = std::min(low, x);
            high = std::max(high, x);
        };
        for (std::size_t k = 0; k < 3; ++k) {
            const glm::dvec3& from = at[k];
            const glm::dvec3& to = at[(k + 1) % 3];
            if (from.y == row) add(from.x);
            if ((from.y < row) != (to.y < row)) add(from.x + (row - from.y) * slopes[k]);
        }
        if (high < low) return {};
        return {std::max(static_cast<int>(std::ceil(low - kSlack)), 0),
                std::min(static_cast<int>(std::floor(high + kSlack)), columns_ - 1)};
    }

    /// Draws the rows of a triangle from `top` to `bottom`.
    void draw(const Corners& at, int top, int bottom) {
        const glm::dvec3 b = at[1] - at[0];
        const glm::dvec3 c = at[2] - at[0];
        const double area = areaOf(at);
        const double slopeX = (b.z * c.y - c.z * b.y) / area;
        const double slopeY = (c.z * b.x - b.z * c.x) / area;
        const auto [least, most] = std::minmax({at[0].z, at[1].z, at[2].z});
        const auto low = static_cast<float>(std::clamp(least, 0.0, double(kMostSteps)));
        const auto high = static_cast<float>(std::clamp(most, 0.0, double(kMostSteps)));
        const auto [firstY, lastY] = std::minmax({at[0].y, at[1].y, at[2].y});
        const int first = std::max(top, static_cast<int>(std::ceil(std::max(firstY, 0.0))));
        const int last = std::min(bottom, static_cast<int>(std::floor(lastY)));
        std::array<double, 3> slopes;  // of each edge, columns a row
        for (std::size_t k = 0; k < 3; ++k) {
            const glm::dvec3 along = at[(k + 1) % 3] - at[k];
            slopes[k] = along.y == 0.0 ? 0.0 : along.x / along.y;
        }
        for (int row = first; row <= last; ++row) {
            const Span span = spanOf(at, slopes, row);
            const auto start = static_cast<float>(at[0].z + slopeX * (span.first - at[0].x) + slopeY * (row - at[0].y));
            const auto slope = static_cast<float>(slopeX);
            std::uint16_t* heights =
                &map_.heights[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_)] + span.first;
            for (int k = 0; k <= span.last - span.first; ++k) {
                const float height = std::min(std::max(start + slope * static_cast<float>(k), low), high);
                const auto steps = static_cast<std::uint16_t>(static_cast<int>(height + 0.5F));
                heights[k] = std::max(heights[k], steps);
            }
        }
    }

    const DrawnMeshes& meshes_;
    DepthMap& map_;
    int columns_, rows_;              // of heights, two for each texel
    std::vector<glm::vec3> corners_;  // of all meshes, as in Corners
};

}  // namespace

DepthMap meshDepthMap(const LightBasis& basis, const DepthMapGrid& grid, const DrawnMeshes& meshes, DepthMap old) {
    DepthMap map = sizedDepthMap(grid, std::move(old));
    MeshHeights(basis, meshes, map).drawAll();
    findHeightBounds(map);
    return map;
}

}  // namespace render
