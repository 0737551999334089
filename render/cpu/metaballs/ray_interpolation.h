// Interpolation of the surface of metaballs between rays that were cast: where the surface is smooth, only a quarter of
// a picture's rays have to be cast. Called by metaball_frame.cpp.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include <glm/glm.hpp>

#include "render/cpu/metaballs/metaball_cast.h"

namespace render {

/// Number of columns, and of rows, of cast rays in a tile: every second pixel of every second row.
inline constexpr std::size_t kCoarseSide = kTileSize / 2;

/// Hits of a tile's cast rays, row by row, and of the first column and row of cast rays beyond the tile, so that every
/// pixel of the tile lies between cast rays.
struct CoarseHits {
    static constexpr std::size_t kSide = kCoarseSide + 1;
    using Values = std::array<float, kSide * kSide>;

    Values depth{};                           ///< view depth of the hit, m; negative without a hit
    Values maxField{};                        ///< greatest value of the field at the samples of the ray
    std::array<Values, 3> normal{}, color{};  ///< unit normal in view coordinates, and linear RGB
    std::array<Values, 3> sky{};  ///< sky visibility along the normal, against it and along the mirrored ray

    /// Copies the hits of the tile's own rays. @param block  rays through kCoarsePixels
    void set(const RayBlock& block, bool hasSky);
    /// Sets the rays in the column and the row beyond the tile to no hit.
    void clearBorder();
    /// Copies the hit of a ray of a neighboring tile to the column or the row beyond this tile.
    void setBorder(std::size_t column, std::size_t row, const CoarseHits& other, std::size_t otherColumn,
                   std::size_t otherRow);
};

/// The pixels of a tile that are cast (column + 16 row), one quarter of the tile after the other, so that the rays of a
/// vector are close together.
extern const std::array<std::uint8_t, kCoarseSide * kCoarseSide> kCoarsePixels;

/// Fills a block with the hits of all pixels of a tile, row by row. The hit of a pixel between two cast rays is
/// interpolated: its depth lies on the cubic through the depths and slopes of the two hits (Hermite), its normal, color
/// and sky visibility are their means. In the middle of four cast rays the results of the two diagonals are averaged. A
/// pixel hits nothing if the cast rays around it miss the surface by more than the field can rise within a pixel. The
/// result depends on the hits of the surrounding rays alone, bit for bit, not on the instruction set.
/// @param corner   position of the tile's first cast ray on the picture, pixels
/// @param isRough  set for the pixels that can neither be interpolated nor be known to hit nothing: they have to be
/// cast
void interpolateRays(const MetaballScene& scene, const CoarseHits& coarse, SmoothnessLimits limits, glm::vec2 corner,
                     RayBlock& block, std::array<bool, kTilePixels>& isRough);

}  // namespace render
