// The ray cast of the metaball field: where rays first meet the surface, as many rays at a time as a SIMD vector holds.
// Called for each tile of the picture and of the light's depth map.
#pragma once

#include <array>
#include <cstddef>

#include "render/prepare/cells/tiles.h"
#include "render/prepare/metaball_scene.h"

namespace render {

/// Up to a tile's worth of rays and what they hit, as a structure of arrays.
struct RayBlock {
    // Set by the caller:
    std::size_t count = 0;
    alignas(64) std::array<float, kTilePixels> x;  ///< positions of the rays on the picture, pixels
    alignas(64) std::array<float, kTilePixels> y;
    alignas(64) std::array<float, kTilePixels> minDepth;  ///< view depth at which the search for the surface begins, m
    alignas(64) std::array<float, kTilePixels> maxDepth;  ///< view depth at which the search ends, m
    // Set by castBlock():
    alignas(64) std::array<float, kTilePixels> depth;     ///< view depth of the hit, m; negative: no hit
    alignas(64) std::array<float, kTilePixels> maxField;  ///< greatest value of the field at the samples of the ray
    alignas(64) TileVec3 normal;                          ///< unit normal at the hit, in view coordinates
    alignas(64) TileVec3 color;                           ///< color of the surface at the hit, linear RGB
    /// Sky visibility along the normal, against it and along the mirrored ray; only with MetaballScene::hasSky.
    alignas(64) TileVec3 sky;
};

/// Casts the rays of a block, all within one tile. Normals, colors and sky visibilities are written if the scene has
/// attributes.
///
/// A ray's result depends on its own position and limits and on the tile alone, bit for bit, neither on the other rays
/// of the block nor on the instruction set: the samples stand on a grid common to the tile, a ball out of a ray's reach
/// adds exactly 0, and multiplications and additions are never fused.
void castBlock(const MetaballScene& scene, std::size_t tile, RayBlock& block);

}  // namespace render
