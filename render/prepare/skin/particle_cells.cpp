// Fits a grid to the particles, and sorts them into its cells.
#include "render/prepare/skin/particle_cells.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "render/picture/bounds.h"
#include "render/prepare/cells/cell_order.h"
#include "render/prepare/cells/tiles.h"

namespace render {

namespace {

/// Places cells around the particles, and makes them wider if there were too many.
void fitToPositions(std::span<const Sphere> particles, ParticleCells& cells) {
    Bounds<glm::vec3> bounds;
    for (const Sphere& particle : particles) bounds.add(particle.center);
    cells.low = bounds.low;
    const auto countAlong = [&](int axis) {
        return std::floor(double(bounds.high[axis] - bounds.low[axis]) / cells.side) + 1.0;
    };
    while (countAlong(0) * countAlong(1) * countAlong(2) > kMostCellsToSort) cells.side *= 2.0F;
    for (int axis = 0; axis < 3; ++axis) cells.count[axis] = static_cast<int>(countAlong(axis));
}

}  // namespace

void fitToRadii(std::span<const Sphere> particles, float reach, ParticleCells& cells) {
    cells.smallestRadius = std::numeric_limits<float>::max();
    cells.largestRadius = std::numeric_limits<float>::min();
    for (const Sphere& particle : particles) {
        if (particle.radius <= 0.0F) continue;
        cells.smallestRadius = std::min(cells.smallestRadius, particle.radius);
        cells.largestRadius = std::max(cells.largestRadius, particle.radius);
    }
    cells.side = reach * cells.largestRadius;
    // A kernel may end at a particle's distance less its radius, which is less than half of the ball's.
    if (cells.smallestRadius < 0.5F * cells.largestRadius) cells.side += 0.5F * cells.largestRadius;
}

ParticleCells sortIntoCells(std::span<const Sphere> particles, float reach) {
    ParticleCells cells;
    fitToRadii(particles, reach, cells);
    fitToPositions(particles, cells);
    std::vector<std::uint32_t> cellOf(particles.size(), kNoCell);
    for (std::size_t k = 0; k < particles.size(); ++k) {
        if (particles[k].radius <= 0.0F) continue;
        const glm::ivec3 cell = cells.cellOf(particles[k].center);
        cellOf[k] = static_cast<std::uint32_t>(cellIndex(cells.count, cell.x, cell.y, cell.z));
    }
    CellOrder order = orderByCell(cellOf, cellIndex(cells.count, 0, 0, cells.count.z));
    cells.begin = std::move(order.begin);
    cells.index = std::move(order.items);
    for (std::vector<float>* values : {&cells.x, &cells.y, &cells.z, &cells.radius}) values->resize(cells.index.size());
    for (std::size_t k = 0; k < cells.index.size(); ++k) {
        const Sphere& particle = particles[cells.index[k]];
        cells.x[k] = particle.center.x;
        cells.y[k] = particle.center.y;
        cells.z[k] = particle.center.z;
        cells.radius[k] = particle.radius;
    }
    return cells;
}

}  // namespace render
