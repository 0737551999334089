// Casts a ray for each pixel of a tile, or for a quarter of the pixels and interpolates the others, and packs the hits.
#include "render/cpu/metaballs/metaball_frame.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "render/cpu/metaballs/ray_interpolation.h"
#include "render/cpu/metaballs/ray_layout.h"
#include "render/cpu/metaballs/silhouette_rays.h"

namespace render {

namespace {

/// Packs the hits of rays through these pixels of a tile.
void packPixels(const MetaballScene& scene, const RayBlock& block, std::span<const std::uint8_t> pixels,
                std::size_t slot, MetaballHits& hits) {
    const std::size_t first = slot * kTilePixels;
    std::array<PackedHit, kTilePixels> packed;
    packHits(scene, block, packed.data());
    for (std::size_t k = 0; k < block.count; ++k) hits.hits[first + pixels[k]] = packed[k];
    for (std::size_t k = 0; k < block.count; ++k) hits.depths[first + pixels[k]] = packed[k].depth();
}

/// Packs the hits of a block that has one ray for each pixel of a tile, row by row.
void packTile(const MetaballScene& scene, const RayBlock& block, std::size_t slot, MetaballHits& hits) {
    const std::size_t first = slot * kTilePixels;
    packHits(scene, block, &hits.hits[first]);
    for (std::size_t k = 0; k < kTilePixels; ++k) hits.depths[first + k] = hits.hits[first + k].depth();
}

/// Completes a tile's coarse hits by the first column and row of the tiles to the right and below, where these tiles
/// have slots.
const CoarseHits& withBorder(MetaballHits& hits, const CellLists& tiles, std::size_t tile) {
    CoarseHits& own = hits.coarse[static_cast<std::size_t>(hits.slots[tile])];
    const auto columns = static_cast<std::size_t>(tiles.columns);
    const auto neighbor = [&](std::size_t right, std::size_t down) -> const CoarseHits* {
        const std::size_t at = tile + right + down * columns;
        if (tile % columns + right >= columns || at >= hits.slots.size() || hits.slots[at] < 0) return nullptr;
        return &hits.coarse[static_cast<std::size_t>(hits.slots[at])];
    };
    own.clearBorder();
    if (const CoarseHits* right = neighbor(1, 0))
        for (std::size_t row = 0; row < kCoarseSide; ++row) own.setBorder(kCoarseSide, row, *right, 0, row);
    if (const CoarseHits* below = neighbor(0, 1))
        for (std::size_t column = 0; column < kCoarseSide; ++column)
            own.setBorder(column, kCoarseSide, *below, column, 0);
    if (const CoarseHits* diagonal = neighbor(1, 1)) own.setBorder(kCoarseSide, kCoarseSide, *diagonal, 0, 0);
    return own;
}

/// View depth at which a ray between four cast rays begins to search for the surface: one radius before the nearest of
/// their hits, as the rays at silhouettes do, so that only a ball that fits between the cast rays may be missed. The
/// search begins at the eye where the cast rays hit nothing, and where the smallest ball does fit between them.
float minDepthBetween(const CameraFrame& frame, const CoarseHits& hits, std::uint8_t pixel, float radius) {
    const std::size_t corner = pixel / kTileSize / 2 * CoarseHits::kSide + pixel % kTileSize / 2;
    float nearest = kNoDepthLimit;
    for (const std::size_t at : {corner, corner + 1, corner + CoarseHits::kSide, corner + CoarseHits::kSide + 1})
        if (hits.depth[at] >= 0.0F) nearest = std::min(nearest, hits.depth[at]);
    // Half the diagonal between four cast rays, two pixels apart, is 1.42 pixels.
    const float least = 1.5F * frame.pixelWidth() * (frame.perspective ? nearest : 1.0F);
    return nearest < kNoDepthLimit && radius > least ? nearest - radius : 0.0F;
}

void castSparsely(const MetaballScene& scene, glm::vec2 offset, MetaballHits& hits) {
    const SmoothnessLimits limits = smoothnessLimits(scene);
    const CellLists& tiles = scene.tiles;
    hits.coarse.resize(hits.silhouettes.size());
    hits.forEachSlot([&](std::size_t tile, std::size_t slot) {
        RayBlock block;
        placeRays(block, tileCorner(tiles, tile), kCoarsePixels, offset);
        castBlock(scene, tile, block);
        hits.coarse[slot].set(block, scene.hasSky);
    });
    hits.forEachSlot([&](std::size_t tile, std::size_t slot) {
        const CoarseHits& coarse = withBorder(hits, tiles, tile);
        const glm::vec2 corner = tileCorner(tiles, tile);
        RayBlock block;
        std::array<bool, kTilePixels> isRough;
        interpolateRays(scene, coarse, limits, pixelMiddle(corner, 0) + offset, block, isRough);
        packTile(scene, block, slot, hits);
        const TilePixels rough = pixelsWhere(isRough);
        placeRays(block, corner, rough, offset);
        for (std::size_t k = 0; k < rough.count; ++k)
            block.minDepth[k] = minDepthBetween(scene.frame, coarse, rough.pixels[k], scene.smallestRadius);
        castBlock(scene, tile, block);
        packPixels(scene, block, rough, slot, hits);
    });
}

void castEveryPixel(const MetaballScene& scene, glm::vec2 offset, MetaballHits& hits) {
    hits.forEachSlot([&](std::size_t tile, std::size_t slot) {
        RayBlock block;
        placeRays(block, tileCorner(scene.tiles, tile), kZCurve, offset);
        castBlock(scene, tile, block);
        packPixels(scene, block, kZCurve, slot, hits);
    });
}

/// Takes the slots from tiles that show no metaballs.
void dropEmptyTiles(MetaballHits& hits) {
    hits.forEachSlot([&](std::size_t tile, std::size_t slot) {
        const bool isSeen = std::ranges::any_of(hits.depthsOf(slot), [](float depth) { return depth > 0.0F; });
        if (!isSeen && hits.silhouettes[slot].samples.empty()) hits.slots[tile] = -1;
    });
}

}  // namespace

void castMetaballs(const MetaballScene& scene, const CastSampling& sampling, MetaballHits& hits) {
    const CellLists& tiles = scene.tiles;
    hits.slots.assign(tiles.cellCount(), -1);
    std::int32_t slotCount = 0;
    for (std::size_t tile = 0; tile < tiles.cellCount(); ++tile)
        if (!tiles.itemsOf(tile).empty()) hits.slots[tile] = slotCount++;
    hits.reserve(static_cast<std::size_t>(slotCount));
    sampling.isSparse ? castSparsely(scene, sampling.offset, hits) : castEveryPixel(scene, sampling.offset, hits);
    if (sampling.atSilhouettes) castSilhouettes(scene, hits);
    // Samplings whose mean is the picture are not sparse: all of them have to keep the same tiles.
    if (sampling.isSparse) dropEmptyTiles(hits);
}

}  // namespace render
