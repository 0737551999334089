// Counting sort: count, add up, place.
#include "render/prepare/skin_cells.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace render {

namespace {

constexpr double kMostSkinCells = 4e6;

void fitTo(std::span<const Sphere> particles, float reach, SkinCells& cells) {
    glm::vec3 high(std::numeric_limits<float>::lowest());
    cells.low = glm::vec3(std::numeric_limits<float>::max());
    float widest = 1e-6F;
    for (const Sphere& particle : particles) {
        cells.low = min(cells.low, particle.center);
        high = max(high, particle.center);
        widest = std::max(widest, particle.radius);
    }
    cells.side = reach * widest;
    const auto along = [&](int axis) { return std::floor(double(high[axis] - cells.low[axis]) / cells.side) + 1.0; };
    while (along(0) * along(1) * along(2) > kMostSkinCells) cells.side *= 2.0F;
    for (int axis = 0; axis < 3; ++axis) cells.count[axis] = static_cast<int>(along(axis));
}

}  // namespace

SkinCells skinCells(std::span<const Sphere> particles, float reach) {
    SkinCells cells;
    fitTo(particles, reach, cells);
    std::vector<std::uint32_t> cellOf(particles.size());
    cells.begin.assign(cells.cellIndex(0, 0, cells.count.z) + 1, 0);
    for (std::size_t k = 0; k < particles.size(); ++k) {
        const glm::ivec3 cell = cells.cellOf(particles[k].center);
        cellOf[k] = static_cast<std::uint32_t>(cells.cellIndex(cell.x, cell.y, cell.z));
        ++cells.begin[cellOf[k] + 1];
    }
    for (std::size_t k = 1; k < cells.begin.size(); ++k) cells.begin[k] += cells.begin[k - 1];
    std::vector<std::uint32_t> next(cells.begin.begin(), cells.begin.end() - 1);
    for (std::vector<float>* values : {&cells.x, &cells.y, &cells.z, &cells.radius})
        values->resize(particles.size() + kDensityBlock);
    cells.index.resize(particles.size());
    for (std::size_t k = 0; k < particles.size(); ++k) {
        const Sphere& particle = particles[k];
        const std::uint32_t place = next[cellOf[k]]++;
        cells.x[place] = particle.center.x;
        cells.y[place] = particle.center.y;
        cells.z[place] = particle.center.z;
        cells.radius[place] = particle.radius;
        cells.index[place] = static_cast<std::uint32_t>(k);
    }
    return cells;
}

}  // namespace render
