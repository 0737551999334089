// The particles around one as vectors of lanes, in the whole blocks that simd_sums-inl.h adds up. Included by Highway's
// rules, from which the guard below comes.
#if defined(RENDER_NEIGHBORHOOD_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RENDER_NEIGHBORHOOD_INL_H_
#undef RENDER_NEIGHBORHOOD_INL_H_
#else
#define RENDER_NEIGHBORHOOD_INL_H_
#endif

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include <hwy/highway.h>

#include "render/prepare/cells/simd_sums-inl.h"
#include "render/prepare/skin/particle_cells.h"

#ifndef RENDER_NEIGHBORHOOD
#define RENDER_NEIGHBORHOOD
namespace render {

/// The particles near a cell in whole blocks: x, y, z and radius, and in the sums of their shifts (ParticleCells)
/// these. The last block is filled up with particles out of reach.
struct Neighborhood {
    std::size_t size = 0;
    std::array<std::vector<float>, 7> values;
};

}  // namespace render
#endif

HWY_BEFORE_NAMESPACE();
namespace render {
namespace HWY_NAMESPACE {

/// Copies the particles of a cell and of those around it.
/// @tparam kValues  4, or 7 with the particles' shifts
/// @param rings  how many cells away along each axis others are copied
template <std::size_t kValues>
void gather(const ParticleCells& cells, glm::ivec3 cell, int rings, Neighborhood& neighborhood) {
    const glm::ivec3 first = max(cell - rings, glm::ivec3(0));
    const glm::ivec3 last = min(cell + rings, cells.count - 1);
    const std::array<const float*, 7> from = {cells.x.data(),       cells.y.data(),        cells.z.data(),
                                              cells.radius.data(),  cells.shift[0].data(), cells.shift[1].data(),
                                              cells.shift[2].data()};
    neighborhood.size = 0;
    for (int z = first.z; z <= last.z; ++z) {
        for (int y = first.y; y <= last.y; ++y) {
            const std::size_t begin = cells.begin[cellIndex(cells.count, first.x, y, z)];
            const std::size_t count = cells.begin[cellIndex(cells.count, last.x, y, z) + 1] - begin;
            for (std::size_t value = 0; value < kValues; ++value) {
                std::vector<float>& to = neighborhood.values[value];
                if (to.size() < neighborhood.size + count + kBlock) to.resize(2 * (neighborhood.size + count + kBlock));
                std::copy_n(from[value] + begin, count, to.begin() + static_cast<std::ptrdiff_t>(neighborhood.size));
            }
            neighborhood.size += count;
        }
    }
    // Far beyond any reach, and near enough for the squared distance to be finite.
    constexpr std::array<float, 7> kOutOfReach = {1e18F, 1e18F, 1e18F, 0.0F, 0.0F, 0.0F, 0.0F};
    for (std::size_t value = 0; value < kValues; ++value)
        std::fill_n(&neighborhood.values[value][neighborhood.size], kBlock, kOutOfReach[value]);
    neighborhood.size = (neighborhood.size + kBlock - 1) / kBlock * kBlock;
}

/// Vectors from a point to the particles of a neighborhood from index k on.
HWY_INLINE Vec3 offsetsFrom(const Vec3& point, const Neighborhood& neighborhood, std::size_t k) {
    const D d;
    const auto& values = neighborhood.values;
    return Vec3{hn::LoadU(d, &values[0][k]), hn::LoadU(d, &values[1][k]), hn::LoadU(d, &values[2][k])} - point;
}

/// Weight of the particles of a neighborhood from index k on in the sums for a particle: k of view.h's smooth skin.
/// @tparam kIsMixed  whether particles may have different radii
/// @param halfReach  half of the reach, in radii; as much as the reach for the K of the anisotropic skin
template <bool kIsMixed>
HWY_INLINE V neighborWeight(glm::vec4 particle, const Vec3& offset, V radius, float halfReach) {
    const V zero = splat(0.0F);
    const V one = splat(1.0F);
    const V support = splat(halfReach) * (splat(particle.w) + radius);
    const V root = hn::Max(zero, one - dot(offset, offset) / (support * support));
    V weight = root * root;
    if constexpr (kIsMixed) {
        const V contrast = splat(3.0F) * (splat(particle.w) - radius) / (splat(particle.w) + radius);
        weight = weight * hn::Max(zero, one - contrast * contrast);
    }
    return weight;
}

}  // namespace HWY_NAMESPACE
}  // namespace render
HWY_AFTER_NAMESPACE();

#endif
