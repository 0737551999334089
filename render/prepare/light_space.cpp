// Shadow casters are sorted by height and binned into cells about as wide as a mean sphere.
#include "render/prepare/light_space.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <tbb/parallel_for.h>

namespace render {

namespace {

// Largest number of columns, and of rows, of the grid. Enough for cells as wide as a sphere in a pile of a million
// spheres. More cells would cost more to clear than they save.
constexpr int kMostCellsPerSide = 512;

/// Column or row of a coordinate, clamped to the grid. Conversion to an integer rounds toward 0 also where it should
/// round down, but those values are clamped to 0.
int cellOf(float at, float origin, float cellSize, int count) {
    return std::clamp(static_cast<int>((at - origin) / cellSize), 0, count - 1);
}

/// Side of a cell: the mean diameter of the spheres, or more if there were too many cells.
float wantedCellSize(std::span<const ViewSphere> spheres, glm::vec2 extent) {
    double sum = 0.0;
    for (const ViewSphere& sphere : spheres) sum += double(sphere.radius);
    return std::max({static_cast<float>(2.0 * sum / static_cast<double>(spheres.size())),
                     extent.x / static_cast<float>(kMostCellsPerSide - 1),
                     extent.y / static_cast<float>(kMostCellsPerSide - 1)});
}

}  // namespace

LightBasis lightBasis(glm::vec3 toLight) {
    LightBasis basis;
    basis.toLight = normalize(toLight);
    const glm::vec3 other =
        std::abs(basis.toLight.x) < 0.9F ? glm::vec3(1.0F, 0.0F, 0.0F) : glm::vec3(0.0F, 1.0F, 0.0F);
    basis.u = normalize(cross(other, basis.toLight));
    basis.v = cross(basis.toLight, basis.u);
    return basis;
}

LightGrid lightGrid(const LightBasis& basis, std::span<const ViewSphere> spheres, float softness) {
    LightGrid grid;
    if (spheres.empty()) return grid;

    // How far the shadow of a sphere reaches, in radii: a sharp edge extends by at most a tenth, a soft one by half its
    // width, see light_visibility.cpp; and one hundredth for the rounding.
    const float margin = std::max(1.11F, 1.01F + 0.5F * softness);
    std::vector<glm::vec3> centers(spheres.size());  // centers of the spheres in light space
    std::vector<float> keys(spheres.size());
    Bounds<glm::vec2> bounds;
    for (std::size_t k = 0; k < spheres.size(); ++k) {
        const glm::vec3 at = basis.toLightSpace(spheres[k].center);
        const float radius = spheres[k].radius;
        centers[k] = at;
        keys[k] = -(at.z + radius);
        bounds.add(glm::vec2(at) - margin * radius, glm::vec2(at) + margin * radius);
    }
    const auto& [low, high] = bounds;
    grid.origin = low;
    grid.cellSize = wantedCellSize(spheres, high - low);
    grid.columns = std::clamp(static_cast<int>((high.x - low.x) / grid.cellSize) + 1, 1, kMostCellsPerSide);
    grid.rows = std::clamp(static_cast<int>((high.y - low.y) / grid.cellSize) + 1, 1, kMostCellsPerSide);

    std::vector<CellItem> items(spheres.size());
    const std::vector<std::uint32_t> order = indicesByKey(keys);
    for (std::size_t k = 0; k < order.size(); ++k) {
        const glm::vec3 at = centers[order[k]];
        const float reach = margin * spheres[order[k]].radius;
        items[k] = {order[k],
                    {cellOf(at.x - reach, low.x, grid.cellSize, grid.columns),
                     cellOf(at.y - reach, low.y, grid.cellSize, grid.rows),
                     cellOf(at.x + reach, low.x, grid.cellSize, grid.columns),
                     cellOf(at.y + reach, low.y, grid.cellSize, grid.rows)}};
    }
    CellLists lists = binIntoCells(items, grid.columns, grid.rows);
    grid.begin = std::move(lists.begin);
    LightSpheres& listed = grid.spheres;
    for (std::vector<float>* values : {&listed.u, &listed.v, &listed.height, &listed.radius})
        values->resize(lists.items.size() + kTileSize);
    tbb::parallel_for(std::size_t{0}, lists.items.size(), [&](std::size_t k) {
        const std::uint32_t sphere = lists.items[k];
        listed.u[k] = centers[sphere].x;
        listed.v[k] = centers[sphere].y;
        listed.height[k] = centers[sphere].z;
        listed.radius[k] = spheres[sphere].radius;
    });
    return grid;
}

}  // namespace render
