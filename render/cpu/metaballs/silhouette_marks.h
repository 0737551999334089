// Where the surface of metaballs breaks off between pixels of a tile. Called by outline_rays.cpp.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "render/prepare/tiles.h"

namespace render {

/// Depths of a tile's pixels and of those around them, row by row; the corners are not looked at.
struct BorderedDepths {
    static constexpr std::ptrdiff_t kSide = kTileSize + 2;

    std::array<float, kSide * kSide> values;

    /// Of a pixel of the tile (column + 16 row).
    static std::size_t indexOf(std::uint8_t place) {
        return static_cast<std::size_t>((place / kTileSize + 1) * kSide + place % kTileSize + 1);
    }
};

/// A pixel's neighbor in one direction, and what is to be marked where its depth is another.
struct MarkedSide {
    std::ptrdiff_t step;  ///< to the neighbor, in BorderedDepths
    std::uint32_t mark;
};

/// The marks of each pixel's sides where depths differ by more than this, joined by `or`. Holds: the same on every
/// instruction set.
std::array<std::uint32_t, kTilePixels> marksOf(const BorderedDepths& depths, float jump,
                                               const std::array<MarkedSide, 4>& sides);

}  // namespace render
