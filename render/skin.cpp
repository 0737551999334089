// Neighbours from a grid of cells as wide as the longest reach; each particle adds its own up in a fixed order.
#include "render/skin.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include <tbb/parallel_for.h>

namespace render {

namespace {

constexpr double kMostSkinCells = 4e6;

/// Particles sorted by cell, copied for the sake of the cache.
struct Cells {
    glm::vec3 low{0.0F};
    float side = 1.0F;
    glm::ivec3 count{1};
    std::vector<std::uint32_t> begin;
    std::vector<glm::vec4> places;  ///< center, radius

    glm::ivec3 cellOf(glm::vec3 at) const {
        return clamp(glm::ivec3(glm::floor((at - low) / side)), glm::ivec3(0), count - 1);
    }
    std::size_t index(int x, int y, int z) const {
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
    cells.begin.assign(cells.index(0, 0, cells.count.z) + 1, 0);
    const auto indexOf = [&](const Sphere& particle) {
        const glm::ivec3 cell = cells.cellOf(particle.center);
        return cells.index(cell.x, cell.y, cell.z);
    };
    for (const Sphere& particle : view.particles) ++cells.begin[indexOf(particle) + 1];
    for (std::size_t k = 1; k < cells.begin.size(); ++k) cells.begin[k] += cells.begin[k - 1];
    std::vector<std::uint32_t> next(cells.begin.begin(), cells.begin.end() - 1);
    cells.places.resize(view.particles.size());
    for (const Sphere& particle : view.particles)
        cells.places[next[indexOf(particle)]++] = glm::vec4(particle.center, particle.radius);
    return cells;
}

// Sums over all particles in reach of one, itself included.
SkinBall smoothed(const Cells& cells, const View& view, const Sphere& particle) {
    const glm::ivec3 here = cells.cellOf(particle.center);
    const glm::ivec3 first = max(here - 1, glm::ivec3(0));
    const glm::ivec3 last = min(here + 1, cells.count - 1);
    float crowd = 0.0F;
    glm::vec3 pull(0.0F);
    for (int z = first.z; z <= last.z; ++z) {
        for (int y = first.y; y <= last.y; ++y) {
            const std::uint32_t end = cells.begin[cells.index(last.x, y, z) + 1];
            for (std::uint32_t k = cells.begin[cells.index(first.x, y, z)]; k < end; ++k) {
                const glm::vec3 off = glm::vec3(cells.places[k]) - particle.center;
                const float reach = view.field.reach * 0.5F * (particle.radius + cells.places[k].w);
                const float root = std::max(0.0F, 1.0F - dot(off, off) / (reach * reach));
                const float share = root * root;
                crowd += share;
                pull += share * off;
            }
        }
    }
    // crowd^(-3/4): between a sum, which swells where many overlap, and a mean, which sinks in at the border.
    const float root = std::sqrt(crowd);
    return {particle.center + kSkinPull * pull / crowd, 1.0F / (root * std::sqrt(root))};
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
    constexpr std::size_t kChunk = 256;
    tbb::parallel_for(std::size_t{0}, balls.size() / kChunk + 1, [&](std::size_t chunk) {
        for (std::size_t k = chunk * kChunk; k < std::min((chunk + 1) * kChunk, balls.size()); ++k) {
            if (view.particles[k].radius > 0.0F) balls[k] = smoothed(cells, view, view.particles[k]);
        }
    });
    return balls;
}

}  // namespace render
