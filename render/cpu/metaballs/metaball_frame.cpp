// Tiles of rays, all cast or a quarter of them and what is in between, and the packing of what they hit.
#include "render/cpu/metaballs/metaball_frame.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "render/cpu/metaballs/binned_field.h"
#include "render/cpu/metaballs/ray_interpolation.h"
#include "render/cpu/metaballs/ray_layout.h"
#include "render/cpu/metaballs/silhouette_rays.h"

namespace render {

namespace {

/// Packs a block's hits to their pixels of the tile.
void putSamples(const FieldCast& cast, const RayBlock& block, std::span<const std::uint8_t> places, std::size_t slot,
                FieldPicture& picture) {
    const std::size_t out = slot * kBlockRays;
    PackedBlock packed;
    packBlock(cast.frame, block, cast.skyVisibility, packed.data());
    for (std::size_t k = 0; k < block.count; ++k) picture.samples[out + places[k]] = packed[k];
    for (std::size_t k = 0; k < block.count; ++k) picture.depths[out + places[k]] = packed[k].depth();
}

/// Packs a block of all pixels of a tile, row by row.
void putTile(const FieldCast& cast, const RayBlock& block, std::size_t slot, FieldPicture& picture) {
    const std::size_t out = slot * kBlockRays;
    packBlock(cast.frame, block, cast.skyVisibility, &picture.samples[out]);
    for (std::size_t k = 0; k < kBlockRays; ++k) picture.depths[out + k] = picture.samples[out + k].depth();
}

/// A tile's coarse hits with those of its neighbors to the right and below; none where they have no slot.
const CoarseHits& withBorder(FieldPicture& picture, const CellLists& tiles, std::size_t tile) {
    CoarseHits& hits = picture.coarse[static_cast<std::size_t>(picture.slots[tile])];
    const auto columns = static_cast<std::size_t>(tiles.columns);
    const auto neighbor = [&](std::size_t right, std::size_t down) -> const CoarseHits* {
        const std::size_t at = tile + right + down * columns;
        if (tile % columns + right >= columns || at >= picture.slots.size() || picture.slots[at] < 0) return nullptr;
        return &picture.coarse[static_cast<std::size_t>(picture.slots[at])];
    };
    hits.clearBorder();
    if (const CoarseHits* right = neighbor(1, 0))
        for (std::size_t row = 0; row < kCoarseSide; ++row) hits.putBorder(kCoarseSide, row, *right, 0, row);
    if (const CoarseHits* below = neighbor(0, 1))
        for (std::size_t column = 0; column < kCoarseSide; ++column)
            hits.putBorder(column, kCoarseSide, *below, column, 0);
    if (const CoarseHits* diagonal = neighbor(1, 1)) hits.putBorder(kCoarseSide, kCoarseSide, *diagonal, 0, 0);
    return hits;
}

// Where a ray between cast ones begins to look for the surface: a radius before the nearest hit around it, as the rays
// of outlines do, so that nothing is missed but what fits between the cast rays. At the eye where they met nothing, and
// where a ball may be as small as that.
float startBetween(const CameraFrame& frame, const CoarseHits& hits, std::uint8_t place, float radius) {
    const std::size_t corner = place / kTileSize / 2 * CoarseHits::kSide + place % kTileSize / 2;
    float nearest = kEndless;
    for (const std::size_t at : {corner, corner + 1, corner + CoarseHits::kSide, corner + CoarseHits::kSide + 1})
        if (hits.depth[at] >= 0.0F) nearest = std::min(nearest, hits.depth[at]);
    // Half the diagonal between four cast rays, two pixels apart, is 1.42 pixels.
    const float least = 1.5F * frame.pixelWidth() * (frame.perspective ? nearest : 1.0F);
    return nearest < kEndless && radius > least ? nearest - radius : 0.0F;
}

// Within a pixel the field rises by less than this times the pixel's share of the smallest ball's radius (a lone ball's
// by half of it, and a pixel's diagonal away).
constexpr float kSteepest = 2.0F;

Smoothness smoothnessOf(const FieldCast& cast, const BinnedField& field) {
    float farthest = 0.0F;
    for (const FieldBall& ball : field.balls) farthest = std::max(farthest, ball.center.z + ball.reach);
    const float pixel = cast.frame.pixelWidth() * (cast.frame.perspective ? farthest : 1.0F);
    // A ray's greatest sample lies a quarter of a radius from the field's peak at most, where a lone ball at the
    // threshold bends by 4 sqrt(threshold) / reach^2 a square radius.
    const float root = std::sqrt(cast.threshold);  // 1 - 1 / reach^2
    const float missed = 0.125F * root * (1.0F - root);
    return {0.02F * field.smallestRadius, cast.threshold - missed - kSteepest * pixel / field.smallestRadius};
}

void castSparsely(const FieldCast& cast, const BinnedField& field, glm::vec2 offset, FieldPicture& picture) {
    const Smoothness smoothness = smoothnessOf(cast, field);
    const CellLists& tiles = *cast.tiles;
    picture.coarse.resize(picture.outlines.size());
    picture.forSlots([&](std::size_t tile, std::size_t slot) {
        RayBlock block;
        placeRays(block, tileCorner(tiles, tile), kCoarsePlaces, offset);
        castBlock(cast, tile, block);
        picture.coarse[slot].put(block, cast.skyVisibility);
    });
    picture.forSlots([&](std::size_t tile, std::size_t slot) {
        const CoarseHits& hits = withBorder(picture, tiles, tile);
        const glm::vec2 corner = tileCorner(tiles, tile);
        RayBlock block;
        std::array<bool, kBlockRays> isRough;
        fillBetween(cast, hits, smoothness, pixelMiddle(corner, 0) + offset, block, isRough);
        putTile(cast, block, slot, picture);
        const TilePlaces rough = placesWhere(isRough);
        placeRays(block, corner, rough, offset);
        for (std::size_t k = 0; k < rough.size(); ++k)
            block.from[k] = startBetween(cast.frame, hits, rough[k], field.smallestRadius);
        castBlock(cast, tile, block);
        putSamples(cast, block, rough, slot, picture);
    });
}

// Tiles where nothing of the surface is seen lose their slots.
void forgetEmptyTiles(FieldPicture& picture) {
    picture.forSlots([&](std::size_t tile, std::size_t slot) {
        const bool isSeen = std::ranges::any_of(picture.depthsOf(slot), [](float depth) { return depth > 0.0F; });
        if (!isSeen && picture.outlines[slot].samples.empty()) picture.slots[tile] = -1;
    });
}

}  // namespace

void castPicture(const CameraFrame& frame, const Skinned& skin, const BinnedField& field, const FieldSampling& sampling,
                 FieldPicture& picture) {
    FieldCast cast = fieldCast(frame, skin.view, field);
    const std::vector<BallLook> looks = ballLooks(skin, field);
    cast.looks = looks;
    cast.skyVisibility = !skin.open.empty();
    const std::size_t tileCount = field.tiles.begin.size() - 1;
    picture.slots.assign(tileCount, -1);
    std::int32_t slotCount = 0;
    for (std::size_t tile = 0; tile < tileCount; ++tile) {
        if (field.tiles.begin[tile + 1] > field.tiles.begin[tile]) picture.slots[tile] = slotCount++;
    }
    picture.makeRoom(static_cast<std::size_t>(slotCount));
    if (sampling.sparse) {
        castSparsely(cast, field, sampling.offset, picture);
    } else {
        picture.forSlots([&](std::size_t tile, std::size_t slot) {
            RayBlock block;
            placeRays(block, tileCorner(field.tiles, tile), kZCurve, sampling.offset);
            castBlock(cast, tile, block);
            putSamples(cast, block, kZCurve, slot, picture);
        });
    }
    if (sampling.extraAtOutlines) castOutlines(cast, field.smallestRadius, picture);
    // Not of samplings whose mean is taken, so that all have the same tiles.
    if (sampling.sparse) forgetEmptyTiles(picture);
}

}  // namespace render
