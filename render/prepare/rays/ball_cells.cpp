// Fits a grid to the balls, and sorts them into its cells: balls keep the order of their particles within a cell.
#include "render/prepare/rays/ball_cells.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "render/picture/bounds.h"
#include "render/prepare/cells/cell_order.h"
#include "render/prepare/cells/tiles.h"
#include "render/prepare/skin/ellipsoid.h"

namespace render {

namespace {

constexpr std::size_t kMostLanes = 16;  // most numbers of a vector

Ellipsoid shapeOf(const SkinBall& ball) {
    const SymmetricMatrix<float>& m = ball.spread;
    return ellipsoidOf({double(m.xx), double(m.yy), double(m.zz), double(m.xy), double(m.xz), double(m.yz)},
                       kernelOf(ball).peak);
}

/// Places cells as wide as the longest kernel around all kernels, wider ones if there were too many.
void placeCells(const View& view, std::span<const SkinBall> balls, glm::vec3 eye, BallCells& cells) {
    Bounds<glm::vec3> bounds;
    cells.side = 0.0F;
    for (std::size_t k = 0; k < balls.size(); ++k) {
        if (view.particles[k].radius <= 0.0F) continue;
        bounds.add(balls[k].center - eye);
        const bool isRound = view.field.skin != Skin::anisotropic;
        cells.side = std::max(cells.side, isRound ? balls[k].reach : shapeOf(balls[k]).radius);
    }
    const glm::vec3 size = bounds.high - bounds.low;
    // A margin of one cell around the centers holds the kernels.
    const auto countAlong = [&](int axis) { return std::floor(double(size[axis]) / double(cells.side)) + 3.0; };
    while (countAlong(0) * countAlong(1) * countAlong(2) > kMostCellsToSort) cells.side *= 1.5F;
    cells.low = bounds.low - cells.side;
    for (int axis = 0; axis < 3; ++axis) cells.count[axis] = static_cast<int>(countAlong(axis));
}

void setForm(const SymmetricMatrix<float>& m, std::size_t to, BallCells& cells) {
    const std::array<float, 6> entries = {m.xx, m.yy, m.zz, m.xy, m.xz, m.yz};
    for (std::size_t k = 0; k < entries.size(); ++k) cells.form[k][to] = entries[k];
}

}  // namespace

BallCells ballCells(const View& view, std::span<const SkinBall> balls, glm::vec3 eye) {
    const std::vector<Sphere>& particles = view.particles;
    BallCells cells;
    if (std::ranges::none_of(particles, [](const Sphere& particle) { return particle.radius > 0.0F; })) return cells;
    placeCells(view, balls, eye, cells);
    std::vector<std::uint32_t> cellOf(balls.size(), kNoCell);
    for (std::size_t k = 0; k < balls.size(); ++k) {
        if (particles[k].radius <= 0.0F) continue;
        const glm::ivec3 cell((balls[k].center - eye - cells.low) / cells.side);
        const glm::ivec3 inGrid = clamp(cell, glm::ivec3(0), cells.count - 1);
        cellOf[k] = static_cast<std::uint32_t>(cellIndex(cells.count, inGrid.x, inGrid.y, inGrid.z));
    }
    CellOrder order = orderByCell(cellOf, cellIndex(cells.count, 0, 0, cells.count.z));
    cells.begin = std::move(order.begin);
    cells.particle.assign(order.items.begin(), order.items.end());
    const std::size_t size = cells.particle.size() + kMostLanes;
    for (std::vector<float>* values : {&cells.x, &cells.y, &cells.z, &cells.peak, &cells.squaredSlope})
        values->resize(size);
    if (view.field.skin == Skin::anisotropic)
        for (std::vector<float>& values : cells.form) values.resize(size);
    for (std::size_t k = 0; k < order.items.size(); ++k) {
        const SkinBall& ball = balls[order.items[k]];
        const BallKernel kernel = kernelOf(ball);
        const glm::vec3 center = ball.center - eye;
        cells.x[k] = center.x;
        cells.y[k] = center.y;
        cells.z[k] = center.z;
        cells.peak[k] = kernel.peak;
        cells.squaredSlope[k] = kernel.slope * kernel.slope;
        if (view.field.skin == Skin::anisotropic) setForm(shapeOf(ball).form, k, cells);
    }
    return cells;
}

}  // namespace render
