// Spheres that cast shadows are sorted by height and binned into cells about as wide as two mean spheres, boxes into
// cells about as wide as most of them.
#include "render/prepare/lighting/light_space.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <tbb/parallel_for.h>

#include "render/picture/parallel_loops.h"

namespace render {

namespace {

// Largest number of columns, and of rows, of a grid. Enough for cells as wide as a sphere in a pile of a million
// spheres. More cells would cost more to clear than they save.
constexpr int kMostCellsPerSide = 512;

// Side of a cell in mean radii. Measured on a pile of a million spheres with soft shadows: with cells half as wide a
// sphere is listed in twice as many, and drawing takes a sixth more time; with wider ones it takes as long.
constexpr double kRadiiPerCell = 4.0;

/// Column or row of a coordinate; of the nearest cell for one beyond the grid.
int cellOf(float at, float origin, float cellSize, int count) {
    return static_cast<int>(std::clamp((at - origin) / cellSize, 0.0F, static_cast<float>(count - 1)));
}

/// Side of a cell: twice the mean diameter of the spheres, or more if there were too many cells.
float wantedCellSize(std::span<const ViewSphere> spheres, glm::vec2 extent) {
    double sum = 0.0;
    for (const ViewSphere& sphere : spheres) sum += double(sphere.radius);
    return std::max({static_cast<float>(kRadiiPerCell * sum / static_cast<double>(spheres.size())),
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
    forAll(spheres.size(), [&](std::size_t k) {
        centers[k] = basis.toLightSpace(spheres[k].center);
        keys[k] = -(centers[k].z + spheres[k].radius);
    });
    Bounds<glm::vec2> bounds;
    for (std::size_t k = 0; k < spheres.size(); ++k) {
        const glm::vec2 at(centers[k]);
        const float reach = margin * spheres[k].radius;
        bounds.add(at - reach, at + reach);
    }
    const glm::vec2 low = bounds.low;
    const glm::vec2 high = bounds.high;
    grid.origin = low;
    grid.cellSize = wantedCellSize(spheres, high - low);
    grid.columns = std::clamp(static_cast<int>((high.x - low.x) / grid.cellSize) + 1, 1, kMostCellsPerSide);
    grid.rows = std::clamp(static_cast<int>((high.y - low.y) / grid.cellSize) + 1, 1, kMostCellsPerSide);

    std::vector<CellItem> items(spheres.size());
    const std::vector<std::uint32_t> order = indicesByKey(keys);
    forAll(order.size(), [&](std::size_t k) {
        const glm::vec3 at = centers[order[k]];
        const float reach = margin * spheres[order[k]].radius;
        items[k] = {order[k],
                    {cellOf(at.x - reach, low.x, grid.cellSize, grid.columns),
                     cellOf(at.y - reach, low.y, grid.cellSize, grid.rows),
                     cellOf(at.x + reach, low.x, grid.cellSize, grid.columns),
                     cellOf(at.y + reach, low.y, grid.cellSize, grid.rows)}};
    });
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

namespace {

// Number of cells to a box, where boxes are small and far apart. Chosen: most cells then have one box or none.
constexpr float kCellsPerBox = 4.0F;

// Widest pixel as a share of a cell. Chosen: in the lists of a cell few boxes are added for it.
constexpr float kPixelsPerCell = 4.0F;

/// The bounds of a box in light space.
struct LightBox {
    glm::vec2 low{0.0F}, high{0.0F};
    float top = 0.0F;
};

LightBox lightBox(const LightBasis& basis, glm::vec3 eye, const BoxObstacle& box) {
    const glm::vec3 low = box.minimum - eye;
    const glm::vec3 high = box.maximum - eye;
    const glm::vec3 half = 0.5F * (high - low);
    const glm::vec3 center = basis.toLightSpace(low + half);
    const glm::vec3 reach{dot(abs(basis.u), half), dot(abs(basis.v), half), dot(abs(basis.toLight), half)};
    // The edge is no narrower than 1e-4 of the diagonal. Single precision places the outline, seen from any point that
    // it matters to, to a few millionths of the distance from the eye.
    const float slack = 2.0e-4F * length(half) + 1.0e-5F * (length(low) + length(high));
    return {glm::vec2(center - reach) - slack, glm::vec2(center + reach) + slack, center.z + reach.z + slack};
}

std::vector<LightBox> lightBoxes(const LightBasis& basis, glm::vec3 eye, std::span<const BoxObstacle> boxes) {
    std::vector<LightBox> found;
    found.reserve(boxes.size());
    for (const BoxObstacle& box : boxes) found.push_back(lightBox(basis, eye, box));
    return found;
}

/// The value at a share of the way through the sorted values. Quantiles are not moved by a few boxes that are vast or
/// far away from the others.
float quantile(std::vector<float>& values, double share) {
    const auto at = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), at, values.end());
    return *at;
}

/// The part of an axis of the light's plane that has most boxes: the middle half of their centers, grown by twice its
/// length on both sides but not beyond the boxes. All of evenly spread boxes lie in it.
std::pair<float, float> gridRange(std::span<const LightBox> boxes, int axis) {
    std::vector<float> centers;
    centers.reserve(boxes.size());
    Bounds<float> all;
    for (const LightBox& box : boxes) {
        centers.push_back(0.5F * (box.low[axis] + box.high[axis]));
        all.low = std::min(all.low, box.low[axis]);
        all.high = std::max(all.high, box.high[axis]);
    }
    const float first = quantile(centers, 0.25);
    const float third = quantile(centers, 0.75);
    const float more = 2.0F * (third - first);
    return {std::max(first - more, all.low), std::min(third + more, all.high)};
}

/// Width of a pixel at the median depth of the boxes, m.
float medianPixelWidth(const CameraFrame& frame, std::span<const BoxObstacle> boxes) {
    if (!frame.perspective) return frame.pixelWidth();
    std::vector<float> depths;
    depths.reserve(boxes.size());
    for (const BoxObstacle& box : boxes)
        depths.push_back(std::max(frame.toView(0.5F * box.minimum + 0.5F * box.maximum).z, 0.0F));
    return frame.pixelWidth() * quantile(depths, 0.5);
}

/// The median extent of the boxes on the light's plane, m.
float medianExtent(std::span<const LightBox> boxes) {
    std::vector<float> extents;
    extents.reserve(boxes.size());
    for (const LightBox& box : boxes)
        extents.push_back(0.5F * (box.high.x - box.low.x) + 0.5F * (box.high.y - box.low.y));
    return quantile(extents, 0.5);
}

/// The cells that list each box.
/// @param softWidth  greatest width of the soft edge of a box's shadow, m
std::vector<CellItem> cellItems(std::span<const LightBox> boxes, float softWidth, const LightBoxGrid& grid) {
    std::vector<CellItem> items;
    items.reserve(boxes.size());
    const glm::vec2 reach = std::max(grid.widestPixel, softWidth) * grid.edgeReach;
    for (const LightBox& box : boxes) {
        const glm::vec2 low = box.low - reach;
        const glm::vec2 high = box.high + reach;
        items.push_back({static_cast<std::uint32_t>(items.size()),
                         {cellOf(low.x, grid.origin.x, grid.cellSize, grid.columns),
                          cellOf(low.y, grid.origin.y, grid.cellSize, grid.rows),
                          cellOf(high.x, grid.origin.x, grid.cellSize, grid.columns),
                          cellOf(high.y, grid.origin.y, grid.cellSize, grid.rows)}});
    }
    return items;
}

/// Whether the lists of all cells together are longer than is worth their memory.
bool isTooLong(std::span<const CellItem> items) {
    constexpr double kMostEntriesPerBox = 64.0;  // chosen; boxes of one size, evenly spread, have about ten
    double entries = 0.0;
    for (const CellItem& item : items)
        entries += double(item.cells.x1 - item.cells.x0 + 1) * double(item.cells.y1 - item.cells.y0 + 1);
    return entries > kMostEntriesPerBox * static_cast<double>(items.size());
}

/// Sets the place and the cells of the grid.
/// @param leastCell  least side of a cell, m
/// @return the cells that list each box
std::vector<CellItem> fitToBoxes(std::span<const LightBox> boxes, float leastCell, float softWidth,
                                 LightBoxGrid& grid) {
    const auto [lowU, highU] = gridRange(boxes, 0);
    const auto [lowV, highV] = gridRange(boxes, 1);
    const glm::vec2 extent{std::max(highU - lowU, 0.0F), std::max(highV - lowV, 0.0F)};
    grid.origin = {lowU, lowV};
    grid.cellSize = std::max({leastCell, medianExtent(boxes), std::numeric_limits<float>::min(),
                              std::sqrt(extent.x * extent.y / (kCellsPerBox * static_cast<float>(boxes.size()))),
                              std::max(extent.x, extent.y) / static_cast<float>(kMostCellsPerSide - 1)});
    const auto cellsAlong = [&](float length) {
        return std::clamp(static_cast<int>(length / grid.cellSize) + 1, 1, kMostCellsPerSide);
    };
    for (;; grid.cellSize *= 2.0F) {
        grid.columns = cellsAlong(extent.x);
        grid.rows = cellsAlong(extent.y);
        grid.widestPixel = grid.cellSize / kPixelsPerCell;
        std::vector<CellItem> items = cellItems(boxes, softWidth, grid);
        if (!isTooLong(items)) return items;
    }
}

/// The lists of all cells, and the list of all boxes.
CellLists listBoxes(std::span<const CellItem> items, const LightBoxGrid& grid) {
    CellLists lists = binIntoCells(items, grid.columns, grid.rows);
    for (const CellItem& item : items) lists.items.push_back(item.index);
    lists.begin.push_back(static_cast<std::uint32_t>(lists.items.size()));
    return lists;
}

/// Sets what the outlines of shadows need of the light.
///
/// The edge of a shadow is as wide as a pixel or as the soft edge, and half of it lies outside of the outline.
/// box_shadows-inl.h measures the distance from the nearest of the lines through the sides of the outline: where it
/// is at most e outside, gap_ij >= -e sqrt(1/l_i^2 + 1/l_j^2) for each two axes. Moving all faces of the box outward by
/// e adds e (1/|l_i| + 1/|l_j|) to the gap, which is more. So where there is any shadow, the ray to the light meets the
/// box that is half the width of the edge larger on all sides.
void setLight(const LightBasis& basis, LightBoxGrid& grid) {
    for (int axis = 0; axis < 3; ++axis) {
        const float along = basis.toLight[axis];
        grid.inverse[axis] = 1.0F / (std::abs(along) > 1.0e-6F ? along : 1.0e-6F);
    }
    const auto scaleOf = [](float a, float b) { return 1.0F / std::sqrt(a * a + b * b); };
    grid.gapScale = {scaleOf(grid.inverse.x, grid.inverse.y), scaleOf(grid.inverse.y, grid.inverse.z),
                     scaleOf(grid.inverse.z, grid.inverse.x)};
    // Half the width, and a tenth of that for the rounding.
    const auto reachAlong = [](glm::vec3 axis) {
        return 0.55F * (std::abs(axis.x) + std::abs(axis.y) + std::abs(axis.z));
    };
    grid.edgeReach = {reachAlong(basis.u), reachAlong(basis.v)};
}

}  // namespace

LightBoxGrid lightBoxGrid(const LightBasis& basis, const CameraFrame& frame, std::span<const BoxObstacle> boxes,
                          float softWidth) {
    LightBoxGrid grid;
    if (boxes.empty()) return grid;
    const std::vector<LightBox> inLight = lightBoxes(basis, frame.eye, boxes);
    setLight(basis, grid);
    // Cells are wide enough for the pixels of boxes at twice the median depth.
    const float leastCell = 2.0F * kPixelsPerCell * medianPixelWidth(frame, boxes);
    const std::vector<CellItem> items = fitToBoxes(inLight, leastCell, softWidth, grid);
    CellLists lists = listBoxes(items, grid);
    grid.begin = std::move(lists.begin);
    LightBoxes& listed = grid.boxes;
    listed.index = std::move(lists.items);
    for (std::vector<float>* values : {&listed.lowU, &listed.highU, &listed.lowV, &listed.highV, &listed.top})
        values->resize(listed.index.size() + kTileSize);
    for (std::size_t k = 0; k < listed.index.size(); ++k) {
        const LightBox& box = inLight[listed.index[k]];
        listed.lowU[k] = box.low.x;
        listed.highU[k] = box.high.x;
        listed.lowV[k] = box.low.y;
        listed.highV[k] = box.high.y;
        listed.top[k] = box.top;
    }
    return grid;
}

}  // namespace render
