// A counting sort: balls keep the order of their particles within a cell.
#include "render/prepare/rays/ball_cells.h"

#include <algorithm>
#include <cmath>

#include "render/picture/bounds.h"
#include "render/prepare/cells/tiles.h"
#include "render/prepare/skin/ellipsoid.h"

namespace render {

namespace {

constexpr std::size_t kMostLanes = 16;  // most numbers of a vector
constexpr double kMostCells = 4e6;      // largest number of cells; chosen: they take 16 MB

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
    while (countAlong(0) * countAlong(1) * countAlong(2) > kMostCells) cells.side *= 1.5F;
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
    const auto cellOf = [&](std::size_t k) {
        const glm::ivec3 cell =
            clamp(glm::ivec3((balls[k].center - eye - cells.low) / cells.side), glm::ivec3(0), cells.count - 1);
        return cellIndex(cells.count, cell.x, cell.y, cell.z);
    };
    cells.begin.assign(cellIndex(cells.count, 0, 0, cells.count.z) + 1, 0);
    for (std::size_t k = 0; k < balls.size(); ++k)
        if (particles[k].radius > 0.0F) ++cells.begin[cellOf(k) + 1];
    for (std::size_t k = 1; k < cells.begin.size(); ++k) cells.begin[k] += cells.begin[k - 1];
    std::vector<std::uint32_t> next(cells.begin.begin(), cells.begin.end() - 1);
    for (std::vector<float>* values : {&cells.x, &cells.y, &cells.z, &cells.peak, &cells.slope})
        values->resize(cells.begin.back() + kMostLanes);
    if (view.field.skin == Skin::anisotropic)
        for (std::vector<float>& values : cells.form) values.resize(cells.begin.back() + kMostLanes);
    cells.particle.resize(cells.begin.back());
    for (std::size_t k = 0; k < balls.size(); ++k) {
        if (particles[k].radius <= 0.0F) continue;
        const std::size_t to = next[cellOf(k)]++;
        const BallKernel kernel = kernelOf(balls[k]);
        const glm::vec3 center = balls[k].center - eye;
        cells.x[to] = center.x;
        cells.y[to] = center.y;
        cells.z[to] = center.z;
        cells.peak[to] = kernel.peak;
        cells.slope[to] = kernel.slope;
        cells.particle[to] = static_cast<std::int32_t>(k);
        if (view.field.skin == Skin::anisotropic) setForm(shapeOf(balls[k]).form, to, cells);
    }
    return cells;
}

}  // namespace render
