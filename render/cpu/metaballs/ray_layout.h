// Which pixels of their tile the rays of a block go through, and in which order. Used by everything that casts
// metaballs.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include <glm/glm.hpp>

#include "render/cpu/metaballs/metaball_cast.h"
#include "render/prepare/cells/tiles.h"

namespace render {

constexpr std::array<std::uint8_t, kTilePixels> zCurve() {
    std::array<std::uint8_t, kTilePixels> pixels{};
    for (unsigned k = 0; k < kTilePixels; ++k) {
        unsigned x = 0;
        unsigned y = 0;
        for (unsigned bit = 0; bit < 4; ++bit) {
            x |= ((k >> (2 * bit)) & 1U) << bit;
            y |= ((k >> (2 * bit + 1)) & 1U) << bit;
        }
        pixels[k] = static_cast<std::uint8_t>(y * kTileSize + x);
    }
    return pixels;
}

/// A tile's pixels (column + 16 row) along a Z-order curve: any 4, 8 or 16 in a row form a compact block, whose rays
/// meet few balls.
inline constexpr std::array<std::uint8_t, kTilePixels> kZCurve = zCurve();

/// A list of pixels of a tile.
struct TilePixels {
    std::array<std::uint8_t, kTilePixels> pixels;
    std::size_t count = 0;

    TilePixels() {}  // leaves the list of pixels uninitialized
    const std::uint8_t* begin() const { return pixels.data(); }
    const std::uint8_t* end() const { return pixels.data() + count; }
};

/// The pixels of a tile whose flag is set, along the Z curve.
inline TilePixels pixelsWhere(const std::array<bool, kTilePixels>& flags) {
    TilePixels found;
    std::size_t count = 0;
    // Without a branch, which would be mispredicted too often: a pixel is written whether it counts or not.
    for (const std::uint8_t pixel : kZCurve) {
        found.pixels[count] = pixel;
        count += flags[pixel] ? 1U : 0U;
    }
    found.count = count;
    return found;
}

/// View depth at which the search of a ray without a limit ends (RayBlock::maxDepth).
inline constexpr float kNoDepthLimit = std::numeric_limits<float>::infinity();

/// The middle of a pixel of the tile with this top left corner, in pixels of the picture.
inline glm::vec2 pixelMiddle(glm::vec2 corner, std::uint8_t pixel) {
    return corner + glm::vec2(int{pixel} % kTileSize, int{pixel} / kTileSize) + 0.5F;
}

/// Fills a block with rays through these pixels of a tile, in this order, without limits.
/// @param offset  of each ray from its pixel's middle, pixels
inline void placeRays(RayBlock& block, glm::vec2 corner, std::span<const std::uint8_t> pixels, glm::vec2 offset) {
    block.count = pixels.size();
    std::fill_n(block.minDepth.begin(), pixels.size(), 0.0F);
    std::fill_n(block.maxDepth.begin(), pixels.size(), kNoDepthLimit);
    for (std::size_t k = 0; k < pixels.size(); ++k) {
        const glm::vec2 at = pixelMiddle(corner, pixels[k]) + offset;
        block.x[k] = at.x;
        block.y[k] = at.y;
    }
}

}  // namespace render
