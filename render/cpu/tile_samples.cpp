// Primary hits of a tile's samples, and the pixels whose samples hit more than one thing.
#include "render/cpu/tile_samples.h"

#include <algorithm>
#include <bit>

#include "render/cpu/metaballs/ray_layout.h"
#include "render/cpu/raster/mesh_hits.h"
#include "render/cpu/raster/smooth_hits.h"

namespace render {

namespace {

/// Places one ray through each pixel of a tile, row by row.
/// @param first  position of the first ray on the picture, pixels
void placeRays(glm::vec2 first, TileRays& rays) {
    for (std::size_t row = 0; row < kTileSize; ++row) {
        for (std::size_t column = 0; column < kTileSize; ++column) {
            rays.x[row * kTileSize + column] = first.x + static_cast<float>(static_cast<int>(column));
            rays.y[row * kTileSize + column] = first.y + static_cast<float>(static_cast<int>(row));
        }
    }
}

/// Replaces the hit of ray k by another one if that is nearer. It has no branches, so that compilers vectorize loops
/// that call it.
/// @param depth  view depth of the other hit, m; 0 if there is none
void keepNearer(TileRays& rays, std::size_t k, float depth, std::int32_t hitId) {
    const bool isNearer = (depth > 0.0F) & (depth < rays.depth[k]);
    rays.depth[k] = isNearer ? depth : rays.depth[k];
    rays.hitId[k] = isNearer ? hitId : rays.hitId[k];
}

}  // namespace

bool TileContents::hasMeshes(std::size_t tile) const {
    return geometry.meshes != nullptr && !geometry.meshes->tiles.itemsOf(tile).empty();
}

TileKind TileContents::kindOf(std::size_t tile) const {
    const bool hasObjects =
        hasSpheres(tile) || hasBoxes(tile) || hasMeshes(tile) || hasMetaballs(tile) || hasLines(tile);
    return hasObjects ? TileKind::mixed : ground[tile];
}

TileSamples::TileSamples(const TileContents& contents, SampleOffsets offsets, std::size_t tile)
    : contents_(contents), tile_(tile), samples_(rays_.data(), offsets.size()) {
    const glm::vec2 corner = tileCorner(*contents.geometry.tiles, tile);
    for (std::size_t s = 0; s < offsets.size(); ++s) placeRays(corner + 0.5F + offsets[s], samples_[s]);
    const FlatGeometry flats{contents.ground[tile] != TileKind::background, contents.geometry.boxTiles->itemsOf(tile)};
    for (TileRays& rays : samples_) findFlatHits(contents.geometry, flats, rays);
    if (contents.hasMetaballs(tile)) addMetaballs();
    if (contents.hasSpheres(tile)) findSphereHits(contents.geometry, tile, samples_);
    if (!contents.hasMeshes(tile)) return;
    findMeshHits(contents.geometry, tile, samples_);
    if (samples_.size() > 1) mergeSmoothHits(contents.geometry, samples_);
}

void TileSamples::findEdges(TileEdges& edges) const {
    edges.pixels.clear();
    edges.hits.clear();
    const std::array<std::int32_t, kTilePixels>& first = samples_[0].hitId;
    std::array<std::int32_t, kTilePixels> differences{};
    for (std::size_t s = 1; s < samples_.size(); ++s)
        for (std::size_t k = 0; k < kTilePixels; ++k) differences[k] |= samples_[s].hitId[k] ^ first[k];
    std::array<bool, kTilePixels> isEdge;
    for (std::size_t k = 0; k < kTilePixels; ++k) isEdge[k] = differences[k] != 0;
    for (const std::uint8_t pixel : pixelsWhere(isEdge)) addEdge(pixel, edges);
}

/// All samples of a pixel hit what the ray through the pixel's middle hits, apart from those samples at silhouettes for
/// which rays of their own were cast.
void TileSamples::addMetaballs() {
    struct Found {
        std::array<float, kTilePixels> depth;
        std::array<std::int32_t, kTilePixels> hitId;
    };
    std::array<Found, 4> found;
    const MetaballHits& metaballs = *contents_.metaballs;
    const auto first = kHitMetaballs + static_cast<std::int32_t>(slot() * kTilePixels);
    std::ranges::copy(metaballs.depthsOf(slot()), found[0].depth.begin());
    for (std::size_t k = 0; k < kTilePixels; ++k) found[0].hitId[k] = first + static_cast<std::int32_t>(k);
    for (std::size_t s = 1; s < samples_.size(); ++s) found[s] = found[0];
    if (samples_.size() > 1) {
        const SilhouetteHits& silhouettes = metaballs.silhouettes[slot()];
        for (std::size_t k = 0; k < silhouettes.samples.size(); ++k) {
            const auto [pixel, sample] = silhouettes.samples[k];
            found[sample].depth[pixel] = silhouettes.hits[k].depth();
            found[sample].hitId[pixel] = kHitMetaballs + static_cast<std::int32_t>(silhouettes.firstIndex + k);
        }
    }
    for (std::size_t s = 0; s < samples_.size(); ++s)
        for (std::size_t k = 0; k < kTilePixels; ++k) keepNearer(samples_[s], k, found[s].depth[k], found[s].hitId[k]);
}

void TileSamples::addEdge(std::uint8_t pixel, TileEdges& edges) const {
    constexpr std::size_t kSamples = 4;
    std::array<std::int32_t, kSamples> hitIds;
    for (std::size_t s = 0; s < kSamples; ++s) hitIds[s] = rays_[s].hitId[pixel];
    std::uint8_t count = 0;
    // Equal hits are found without branches, which would be mispredicted too often.
    for (unsigned left = (1U << kSamples) - 1U; left != 0; ++count) {
        const std::int32_t hitId = hitIds[static_cast<std::size_t>(std::countr_zero(left))];
        unsigned mask = 0;
        for (std::size_t s = 0; s < kSamples; ++s) mask |= unsigned{hitIds[s] == hitId} << s;
        edges.hits.push_back({hitId, mask});
        left &= ~mask;
    }
    edges.pixels.push_back({pixel, count});
}

}  // namespace render
