// The surface of metaballs between rays that were cast: where it is smooth, a quarter of the rays tells the rest.
// Called by metaball_frame.cpp.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include <glm/glm.hpp>

#include "render/cpu/metaballs/metaball_cast.h"
#include "render/picture/camera_frame.h"

namespace render {

/// Columns and rows of rays of a tile where every second pixel of every second row is cast.
inline constexpr std::size_t kCoarseSide = kTileSize / 2;

/// Hits of these rays, row by row, and of the first column and row after the tile, so that nothing lies beyond.
struct CoarseHits {
    static constexpr std::size_t kSide = kCoarseSide + 1;
    using Values = std::array<float, kSide * kSide>;

    Values depth{};                                   ///< in view; negative: nothing
    Values most{};                                    ///< the greatest sample of the field on the way
    std::array<Values, 3> normal{}, color{}, open{};  ///< of hits; open: where it is asked for

    /// Takes a block of rays that go through kCoarsePlaces.
    void put(const RayBlock& block, bool skyVisibility);
    /// No hits, and no field, in the column and the row after the tile.
    void clearBorder();
    void putBorder(std::size_t column, std::size_t row, const CoarseHits& other, std::size_t otherColumn,
                   std::size_t otherRow);
};

/// What counts as smooth.
struct Smoothness {
    float depth = 0.0F;  ///< m, between what their tangent planes say of the middle, and between these and their chord
    float most = 0.0F;   ///< of the field on rays beside which there is no surface
};

/// Every second pixel of every second row (columns plus 16 rows), a quarter of the tile after the other: each group of
/// rays is compact, and so are the rows of a quarter.
extern const std::array<std::uint8_t, kCoarseSide * kCoarseSide> kCoarsePlaces;

/// Makes a block of a tile's pixels, row by row, of its cast rays and those of its neighbors. In between they are on a
/// cubic through depths and slopes of two hits (Hermite) or of two pairs, with the mean of normals, colors and
/// openness; or there is nothing, where the rays around missed the surface by more than the field may rise within a
/// pixel. Where neither is sure, isRough tells. corner: the first cast ray's place in the picture. Holds: a ray's
/// result depends on the hits around it alone, bit for bit, not on the number of lanes.
void fillBetween(const FieldCast& cast, const CoarseHits& coarse, Smoothness smoothness, glm::vec2 corner,
                 RayBlock& block, std::array<bool, kBlockRays>& isRough);

}  // namespace render
