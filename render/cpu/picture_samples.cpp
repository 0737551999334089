// Rays through a tile, and which of its pixels show more than one thing.
#include "render/cpu/picture_samples.h"

#include <algorithm>
#include <bit>

#include "render/cpu/metaballs/ray_layout.h"

namespace render {

namespace {

/// A ray through each pixel of a tile, row by row; first: the place of the first.
void placeRays(glm::vec2 first, std::array<float, kTilePixels>& x, std::array<float, kTilePixels>& y) {
    for (std::size_t row = 0; row < kTileSize; ++row) {
        for (std::size_t column = 0; column < kTileSize; ++column) {
            x[row * kTileSize + column] = first.x + static_cast<float>(static_cast<int>(column));
            y[row * kTileSize + column] = first.y + static_cast<float>(static_cast<int>(row));
        }
    }
}

bool hasItems(const CellLists& lists, std::size_t tile) {
    return lists.begin[tile + 1] > lists.begin[tile];
}

/// Without branches, so that compilers turn loops over it into lanes. depth: 0 where there is no surface.
void seeField(TileRays& rays, std::size_t k, float depth, std::int32_t seen) {
    const bool isNearest = (depth > 0.0F) & (depth < rays.depth[k]);
    rays.depth[k] = isNearest ? depth : rays.depth[k];
    rays.seen[k] = isNearest ? seen : rays.seen[k];
}

}  // namespace

bool TileContents::hasSpheres(std::size_t tile) const {
    return hasItems(*solids.tiles, tile);
}

bool TileContents::hasLines(std::size_t tile) const {
    return hasItems(lines.tiles, tile);
}

bool TileContents::isEmpty(std::size_t tile) const {
    return !hasSpheres(tile) && boxes[tile] == 0 && !hasField(tile);
}

bool TileContents::isBackground(std::size_t tile) const {
    return isEmpty(tile) && ground[tile].kind == GroundKind::none;
}

bool TileContents::isGround(std::size_t tile) const {
    return isEmpty(tile) && (ground[tile].kind == GroundKind::plain || ground[tile].kind == GroundKind::occluded);
}

TileSamples::TileSamples(const TileContents& contents, SampleOffsets offsets, std::size_t tile)
    : contents_(contents), tile_(tile), samples_(rays_.data(), offsets.size()) {
    const glm::vec2 corner = tileCorner(*contents.solids.tiles, tile);
    for (std::size_t s = 0; s < offsets.size(); ++s)
        placeRays(corner + 0.5F + offsets[s], samples_[s].x, samples_[s].y);
    look();
}

void TileSamples::look() {
    if (contents_.hasField(tile_)) contents_.field->fetch(fieldSlot());
    if (fieldFills()) {
        samples_ = samples_.first(1);
        samples_[0].depth.fill(kFarDepth);
        lookAtField();
        return;
    }
    if (isSpheresOnGround()) {
        lookAtSpheresOnGround(contents_.solids, tile_, samples_);
        return;
    }
    const Flats flats{contents_.ground[tile_].kind != GroundKind::none, contents_.boxes[tile_] != 0};
    for (TileRays& rays : samples_) lookAtFlats(contents_.solids, flats, rays);
    if (contents_.hasField(tile_)) lookAtField();
    if (contents_.hasSpheres(tile_)) lookAtSpheres(contents_.solids, tile_, samples_);
}

void TileSamples::findEdges(TileEdges& edges) const {
    edges.pixels.clear();
    edges.things.clear();
    const std::array<std::int32_t, kTilePixels>& first = samples_[0].seen;
    std::array<std::int32_t, kTilePixels> differs{};
    for (std::size_t s = 1; s < samples_.size(); ++s)
        for (std::size_t k = 0; k < kTilePixels; ++k) differs[k] |= samples_[s].seen[k] ^ first[k];
    std::array<bool, kTilePixels> several;
    for (std::size_t k = 0; k < kTilePixels; ++k) several[k] = differs[k] != 0;
    for (const std::uint8_t place : placesWhere(several)) addEdge(place, edges);
}

/// Whether the tile shows nothing but metaballs, without an outline: one sample is as good as four.
bool TileSamples::fieldFills() const {
    if (!contents_.hasField(tile_) || !contents_.field->outlines[fieldSlot()].samples.empty()) return false;
    if (contents_.hasSpheres(tile_) || contents_.boxes[tile_] != 0) return false;
    float nearest = kFarDepth;
    float farthest = 0.0F;
    for (const float depth : contents_.field->depthsOf(fieldSlot())) {
        nearest = std::min(nearest, depth);
        farthest = std::max(farthest, depth);
    }
    return nearest > 0.0F && farthest < contents_.ground[tile_].nearest;
}

/// Whether the ground fills the tile behind spheres and nothing else, and no line asks for its depth.
bool TileSamples::isSpheresOnGround() const {
    const GroundKind ground = contents_.ground[tile_].kind;
    if (ground != GroundKind::plain && ground != GroundKind::occluded) return false;
    if (contents_.boxes[tile_] != 0 || contents_.hasLines(tile_)) return false;
    return !contents_.hasField(tile_);
}

void TileSamples::lookAtField() {
    struct Found {
        std::array<float, kTilePixels> depth;
        std::array<std::int32_t, kTilePixels> seen;
    };
    std::array<Found, 4> found;
    const auto first = kSeesField + static_cast<std::int32_t>(fieldSlot() * kBlockRays);
    std::ranges::copy(contents_.field->depthsOf(fieldSlot()), found[0].depth.begin());
    for (std::size_t k = 0; k < kTilePixels; ++k) found[0].seen[k] = first + static_cast<std::int32_t>(k);
    for (std::size_t s = 1; s < samples_.size(); ++s) found[s] = found[0];
    if (samples_.size() > 1) {
        const Outlines& outlines = contents_.field->outlines[fieldSlot()];
        for (std::size_t k = 0; k < outlines.samples.size(); ++k) {
            const auto [pixel, sample] = outlines.samples[k];
            found[sample].depth[pixel] = outlines.shown[k].depth();
            found[sample].seen[pixel] = kSeesField + static_cast<std::int32_t>(outlines.first + k);
        }
    }
    for (std::size_t s = 0; s < samples_.size(); ++s)
        for (std::size_t k = 0; k < kTilePixels; ++k) seeField(samples_[s], k, found[s].depth[k], found[s].seen[k]);
}

void TileSamples::addEdge(std::uint8_t place, TileEdges& edges) const {
    constexpr std::size_t kSamples = 4;
    std::array<std::int32_t, kSamples> seen;
    for (std::size_t s = 0; s < kSamples; ++s) seen[s] = rays_[s].seen[place];
    std::uint8_t count = 0;
    // Which samples show the same cannot be foretold, and is found without branches.
    for (unsigned left = (1U << kSamples) - 1U; left != 0; ++count) {
        const std::int32_t what = seen[static_cast<std::size_t>(std::countr_zero(left))];
        unsigned shows = 0;  // a bit for each sample
        for (std::size_t s = 0; s < kSamples; ++s) shows |= unsigned{seen[s] == what} << s;
        edges.things.push_back({what, shows});
        left &= ~shows;
    }
    edges.pixels.push_back({place, count});
}

}  // namespace render
