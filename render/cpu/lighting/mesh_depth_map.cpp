// The rows of heights are divided into bands, of which each is drawn by one thread. A height is the greatest of all
// triangles over it, so that their order does not matter.
#include "render/cpu/lighting/mesh_depth_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <tbb/parallel_for.h>

#include "render/cpu/lighting/mesh_heights.h"
#include "render/picture/parallel_loops.h"
#include "render/prepare/cells/tiles.h"

namespace render {

namespace {

constexpr int kBandRows = 32;  // rows of heights in a band; chosen

class MeshHeights {
 public:
    MeshHeights(const LightBasis& basis, const DrawnMeshes& meshes, DepthMap& map)
        : meshes_(meshes),
          map_(map),
          columns_(2 * map.columns),
          rows_(2 * map.rows),
          corners_(meshes.positions.size()) {
        forAll(corners_.size(), [&](std::size_t k) {
            const glm::vec3 at = basis.toLightSpace(meshes.positions[k]);
            // The first height of a texel lies a quarter of the texel's side from its corner.
            const glm::vec2 place = (glm::vec2(at) - map.origin) * (2.0F / map.texelSize) - 0.5F;
            corners_[k] = {place, map.stepsOf(at.z)};
        });
    }

    void drawAll() {
        const CellLists bands = listByBand();
        tbb::parallel_for(0, bands.rows, [&](int band) {
            HeightRows rows{nullptr, columns_, band * kBandRows, std::min((band + 1) * kBandRows, rows_) - 1};
            rows.heights = &map_.heights[static_cast<std::size_t>(rows.first) * static_cast<std::size_t>(columns_)];
            std::fill_n(rows.heights, std::ptrdiff_t{rows.last - rows.first + 1} * columns_, std::uint16_t{0});
            drawHeights({corners_, meshes_.triangles}, bands.itemsOf(static_cast<std::size_t>(band)), rows);
        });
    }

 private:
    CellLists listByBand() const {
        const auto items = listAll<CellItem>(meshes_.triangles.size(), [&](std::size_t k, std::vector<CellItem>& list) {
            if (!meshes_.isOpaque(k)) return;
            const auto& [a, b, c] = meshes_.triangles[k].corners;
            const std::array<glm::vec3, 3> at{corners_[a], corners_[b], corners_[c]};
            if (!isTurnedAway(at)) return;
            const auto [top, bottom] = std::minmax({at[0].y, at[1].y, at[2].y});
            const int low = std::clamp(static_cast<int>(std::ceil(top)), 0, rows_ - 1);
            const int high = std::clamp(static_cast<int>(bottom), 0, rows_ - 1);
            if (low <= high) list.push_back({static_cast<std::uint32_t>(k), {0, low / kBandRows, 0, high / kBandRows}});
        });
        return binIntoCells(items, 1, (rows_ + kBandRows - 1) / kBandRows);
    }

    /// Whether the light does not reach the outer side of a triangle.
    /// @param at  as HeightTriangles::corners
    static bool isTurnedAway(const std::array<glm::vec3, 3>& at) {
        const glm::dvec3 b = glm::dvec3(at[1]) - glm::dvec3(at[0]);
        const glm::dvec3 c = glm::dvec3(at[2]) - glm::dvec3(at[0]);
        return b.x * c.y - b.y * c.x < 0.0;
    }

    const DrawnMeshes& meshes_;
    DepthMap& map_;
    int columns_, rows_;              // of heights, two for each texel
    std::vector<glm::vec3> corners_;  // of all meshes, as in HeightTriangles
};

}  // namespace

DepthMap meshDepthMap(const LightBasis& basis, const DepthMapGrid& grid, const DrawnMeshes& meshes, DepthMap old) {
    DepthMap map = sizedDepthMap(grid, std::move(old));
    MeshHeights(basis, meshes, map).drawAll();
    findHeightBounds(map);
    return map;
}

}  // namespace render
