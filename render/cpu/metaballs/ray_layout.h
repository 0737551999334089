// Where the rays of a block go through their tile, and in which order. Used by all that casts metaballs.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include <glm/glm.hpp>

#include "render/cpu/metaballs/metaball_cast.h"
#include "render/prepare/tiles.h"

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

/// Some pixels of a tile.
struct TilePlaces {
    std::array<std::uint8_t, kBlockRays> places;
    std::size_t count = 0;

    /// Leaves the places as they are.
    TilePlaces() {}
    std::size_t size() const { return count; }
    std::uint8_t operator[](std::size_t k) const { return places[k]; }
    const std::uint8_t* begin() const { return places.data(); }
    const std::uint8_t* end() const { return places.data() + count; }
};

/// Those pixels of a tile whose flag is set, along the Z curve.
inline TilePlaces placesWhere(const std::array<bool, kBlockRays>& flags) {
    TilePlaces found;
    std::size_t count = 0;
    // Written whether it counts or not: a branch would be mistaken too often.
    for (const std::uint8_t place : kZCurve) {
        found.places[count] = place;
        count += flags[place] ? 1U : 0U;
    }
    found.count = count;
    return found;
}

/// How far a ray looks for the surface that nothing limits.
inline constexpr float kEndless = std::numeric_limits<float>::infinity();

/// The middle of a pixel; corner: of its tile.
inline glm::vec2 pixelMiddle(glm::vec2 corner, std::uint8_t place) {
    return corner + glm::vec2(int{place} % kTileSize, int{place} / kTileSize) + 0.5F;
}

/// Rays through these pixels of a tile, in this order, without limits.
inline void placeRays(RayBlock& block, glm::vec2 corner, std::span<const std::uint8_t> places, glm::vec2 offset) {
    block.count = places.size();
    std::fill_n(block.from.begin(), places.size(), 0.0F);
    std::fill_n(block.to.begin(), places.size(), kEndless);
    for (std::size_t k = 0; k < places.size(); ++k) {
        const glm::vec2 at = pixelMiddle(corner, places[k]) + offset;
        block.x[k] = at.x;
        block.y[k] = at.y;
    }
}

}  // namespace render
