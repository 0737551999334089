// Neighbours from a grid of cells as wide as the longest reach, gathered once for the particles of a cell.
#include "render/skin.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "render/crowd_sums.h"

namespace render {

namespace {

constexpr double kMostSkinCells = 4e6;

/// Particles sorted by cell, copied for the sake of the cache.
struct Cells {
    glm::vec3 low{0.0F};
    float side = 1.0F;
    glm::ivec3 count{1};
    std::vector<std::uint32_t> begin;
    std::vector<glm::vec4> places;     ///< center, radius
    std::vector<std::uint32_t> index;  ///< of the particle at each place

    /// at: not below `low`, so that conversion rounds down; glm::floor may be a call.
    glm::ivec3 cellOf(glm::vec3 at) const { return min(glm::ivec3((at - low) / side), count - 1); }
    std::size_t cellIndex(int x, int y, int z) const {
        return (static_cast<std::size_t>(z) * static_cast<std::size_t>(count.y) + static_cast<std::size_t>(y)) *
                   static_cast<std::size_t>(count.x) +
               static_cast<std::size_t>(x);
    }
};

Cells sortedToCells(const View& view) {
    Cells cells;
    glm::vec3 high(std::numeric_limits<float>::lowest());
    cells.low = glm::vec3(std::numeric_limits<float>::max());
    float widest = 1e-6F;
    for (const Sphere& particle : view.particles) {
        cells.low = min(cells.low, particle.center);
        high = max(high, particle.center);
        widest = std::max(widest, particle.radius);
    }
    cells.side = view.field.reach * widest;
    const auto along = [&](int axis) { return std::floor(double(high[axis] - cells.low[axis]) / cells.side) + 1.0; };
    while (along(0) * along(1) * along(2) > kMostSkinCells) cells.side *= 2.0F;
    for (int axis = 0; axis < 3; ++axis) cells.count[axis] = static_cast<int>(along(axis));
    cells.begin.assign(cells.cellIndex(0, 0, cells.count.z) + 1, 0);
    const auto indexOf = [&](const Sphere& particle) {
        const glm::ivec3 cell = cells.cellOf(particle.center);
        return cells.cellIndex(cell.x, cell.y, cell.z);
    };
    for (const Sphere& particle : view.particles) ++cells.begin[indexOf(particle) + 1];
    for (std::size_t k = 1; k < cells.begin.size(); ++k) cells.begin[k] += cells.begin[k - 1];
    std::vector<std::uint32_t> next(cells.begin.begin(), cells.begin.end() - 1);
    cells.places.resize(view.particles.size());
    cells.index.resize(view.particles.size());
    for (std::uint32_t k = 0; k < view.particles.size(); ++k) {
        const Sphere& particle = view.particles[k];
        const std::uint32_t place = next[indexOf(particle)]++;
        cells.places[place] = glm::vec4(particle.center, particle.radius);
        cells.index[place] = k;
    }
    return cells;
}

/// All that may be in reach of the particles of one cell, themselves included.
void gather(const Cells& cells, glm::ivec3 cell, Crowd& crowd) {
    const glm::ivec3 first = max(cell - 1, glm::ivec3(0));
    const glm::ivec3 last = min(cell + 1, cells.count - 1);
    crowd.clear();
    for (int z = first.z; z <= last.z; ++z) {
        for (int y = first.y; y <= last.y; ++y) {
            const std::uint32_t begin = cells.begin[cells.cellIndex(first.x, y, z)];
            const std::uint32_t end = cells.begin[cells.cellIndex(last.x, y, z) + 1];
            crowd.add(std::span(cells.places).subspan(begin, end - begin));
        }
    }
    crowd.finish();
}

SkinBall smoothed(const CrowdSum& sum, glm::vec3 center) {
    // crowd^(-3/4): between a sum, which swells where many overlap, and a mean, which sinks in at the border.
    const float root = std::sqrt(sum.crowd);
    return {center + kSkinPull * sum.pull / sum.crowd, 1.0F / (root * std::sqrt(root))};
}

// The particles at these places.
void smooth(const Cells& cells, float reach, std::size_t begin, std::size_t end, std::vector<SkinBall>& balls) {
    thread_local Crowd crowd;
    glm::ivec3 gathered(-1);
    for (std::size_t k = begin; k < end; ++k) {
        const glm::vec4 particle = cells.places[k];
        const glm::ivec3 cell = cells.cellOf(particle);
        if (cell != gathered) gather(cells, cell, crowd);
        gathered = cell;
        if (particle.w > 0.0F) balls[cells.index[k]] = smoothed(sumOver(crowd, particle, reach), particle);
    }
}

}  // namespace

std::vector<SkinBall> skinOf(const View& view) {
    std::vector<SkinBall> balls(view.particles.size());
    if (view.field.skin == Skin::plain) {
        for (std::size_t k = 0; k < balls.size(); ++k) balls[k].center = view.particles[k].center;
        return balls;
    }
    if (balls.empty()) return balls;
    const Cells cells = sortedToCells(view);
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, balls.size(), 64),
                      [&](const auto& range) { smooth(cells, view.field.reach, range.begin(), range.end(), balls); });
    return balls;
}

}  // namespace render
