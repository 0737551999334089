// Where the rays of a block go through their tile, and in which order. Used by all that casts metaballs.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

#include <glm/glm.hpp>

#include "render/metaball_cast.h"
#include "render/tiles.h"

namespace render {

constexpr std::array<std::uint8_t, kBlockRays> zCurve() {
    std::array<std::uint8_t, kBlockRays> places{};
    for (unsigned k = 0; k < kBlockRays; ++k) {
        unsigned x = 0;
        unsigned y = 0;
        for (unsigned bit = 0; bit < 4; ++bit) {
            x |= ((k >> (2 * bit)) & 1U) << bit;
            y |= ((k >> (2 * bit + 1)) & 1U) << bit;
        }
        places[k] = static_cast<std::uint8_t>(y * kTileSize + x);
    }
    return places;
}

/// A tile's pixels (column plus 16 rows) along a Z curve, so that any group of 4, 8 or 16 in a row is compact and its
/// rays meet few balls.
inline constexpr std::array<std::uint8_t, kBlockRays> kZCurve = zCurve();

/// How far a ray looks for the surface that nothing limits.
inline constexpr float kEndless = std::numeric_limits<float>::infinity();

/// The middle of a pixel; corner: of its tile.
inline glm::vec2 pixelMiddle(glm::vec2 corner, std::size_t place) {
    return corner + glm::vec2(place % kTileSize, place / kTileSize) + 0.5F;
}

/// Rays through these pixels of a tile, in this order, without limits.
template <typename Places>
void placeRays(RayBlock& block, glm::vec2 corner, const Places& places, glm::vec2 offset) {
    block.count = places.size();
    for (std::size_t k = 0; k < places.size(); ++k) {
        const glm::vec2 at = pixelMiddle(corner, places[k]) + offset;
        block.x[k] = at.x;
        block.y[k] = at.y;
        block.from[k] = 0.0F;
        block.to[k] = kEndless;
    }
}

}  // namespace render
