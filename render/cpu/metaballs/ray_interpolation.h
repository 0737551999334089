// The surface of metaballs between rays that were cast: where it is smooth, a quarter of a picture's rays tell the
// rest. Called by metaball_frame.cpp.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include <glm/glm.hpp>

#include "render/cpu/metaballs/metaball_cast.h"

namespace render {

/// Columns and rows of cast rays in a tile: every second pixel of every second row.
inline constexpr std::size_t kCoarseSide = kTileSize / 2;

/// Hits of the cast rays, row by row, and of the first column and row beyond the tile, so that every pixel lies
/// between.
struct CoarseHits {
    static constexpr std::size_t kSide = kCoarseSide + 1;
    using Values = std::array<float, kSide * kSide>;

    Values depth{};                                  ///< as in RayBlock; negative: no hit
    Values maxField{};                               ///< as in RayBlock
    std::array<Values, 3> normal{}, color{}, sky{};  ///< of hits; sky: if the scene has it

    /// @param block  rays through kCoarsePixels
    void set(const RayBlock& block, bool hasSky);
    /// No hit, and no field, in the column and the row beyond the tile.
    void clearBorder();
    void setBorder(std::size_t column, std::size_t row, const CoarseHits& other, std::size_t otherColumn,
                   std::size_t otherRow);
};

/// What counts as smooth.
struct SmoothnessLimits {
    float depth =
        0.0F;  ///< between what two hits' tangent planes say of the middle, and between these and the chord, m
    float maxField = 0.0F;  ///< of the field on rays that have no surface beside them
};

/// The pixels that are cast (column + 16 row), one quarter of the tile after the other: each group of rays is compact,
/// and so are the rows of a quarter.
extern const std::array<std::uint8_t, kCoarseSide * kCoarseSide> kCoarsePixels;

/// Fills a block with all pixels of a tile, row by row, from its cast rays and those of its neighbors. The rays in
/// between lie on a cubic through depths and slopes of two hits (Hermite), or of two pairs, with the mean of normals,
/// colors and sky visibilities; or they hit nothing, where the rays around missed the surface by more than the field
/// may rise within a pixel. A ray's result depends on the hits around it alone, bit for bit, not on the instruction
/// set.
/// @param corner   position of the first cast ray on the picture, pixels
/// @param isRough  set for pixels of which neither holds: their rays have to be cast
void interpolateRays(const MetaballScene& scene, const CoarseHits& coarse, SmoothnessLimits limits, glm::vec2 corner,
                     RayBlock& block, std::array<bool, kTilePixels>& isRough);

}  // namespace render
