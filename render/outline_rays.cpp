// Pixels that outlines cross are told by the depths of those around them, which also tell where their rays look.
#include "render/outline_rays.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <utility>

#include "render/ray_places.h"

namespace render {

namespace {

/// Where a pixel's extra rays look for the surface.
struct DepthRange {
    float from = 0.0F;
    float to = kEndless;
};

// The depths of a tile's pixels and of those around them; kNothing where there is no surface.
class Depths {
 public:
    Depths(const FieldPicture& picture, const CellLists& tiles, std::size_t tile) : picture_(picture), tiles_(tiles) {
        const auto columns = static_cast<std::size_t>(tiles.columns);
        const int left = static_cast<int>(tile % columns);
        const int top = static_cast<int>(tile / columns);
        depths_.fill(kNothing);
        copy(left, top, {0, 0}, {kTileSize, kTileSize}, {1, 1});
        copy(left - 1, top, {kTileSize - 1, 0}, {1, kTileSize}, {0, 1});
        copy(left + 1, top, {0, 0}, {1, kTileSize}, {kTileSize + 1, 1});
        copy(left, top - 1, {0, kTileSize - 1}, {kTileSize, 1}, {1, 0});
        copy(left, top + 1, {0, 0}, {kTileSize, 1}, {1, kTileSize + 1});
    }

    // Hit beside miss, or a jump in depth that a pixel's slope does not explain.
    TilePlaces outlines(float jump) const {
        std::array<bool, kBlockRays> found;
        for (std::size_t row = 0; row < kTileSize; ++row) {
            const float* at = &depths_[(row + 1) * kSide + 1];
            std::array<float, kTileSize> most{};
            for (const std::ptrdiff_t step : {std::ptrdiff_t{1}, std::ptrdiff_t{-1}, kSide, -kSide})
                for (std::size_t k = 0; k < kTileSize; ++k)
                    most[k] = std::max(most[k], std::abs(at[static_cast<std::ptrdiff_t>(k) + step] - at[k]));
            for (std::size_t k = 0; k < kTileSize; ++k) found[row * kTileSize + k] = most[k] > jump;
        }
        return placesWhere(found);
    }

    // From a radius before the nearest of what the pixel and its neighbours show; where one of them shows nothing, to
    // two radii behind the farthest: what extra rays see is what the rays around them see.
    DepthRange around(std::uint8_t place, float radius) const {
        const std::ptrdiff_t at = (place / kTileSize + 1) * kSide + place % kTileSize + 1;
        DepthRange range{kEndless, 0.0F};
        bool isOpen = false;
        for (const std::ptrdiff_t step : {std::ptrdiff_t{0}, std::ptrdiff_t{1}, std::ptrdiff_t{-1}, kSide, -kSide}) {
            const float depth = depths_[static_cast<std::size_t>(at + step)];
            isOpen = isOpen || depth == kNothing;
            range.from = depth > 0.0F ? std::min(range.from, depth - radius) : range.from;
            range.to = std::max(range.to, depth + 2.0F * radius);
        }
        return isOpen ? range : DepthRange{range.from, kEndless};
    }

 private:
    static constexpr std::ptrdiff_t kSide = kTileSize + 2;
    static constexpr float kNothing = -1e30F;  // farther than any jump from what is seen

    void copy(int column, int row, glm::ivec2 from, glm::ivec2 size, glm::ivec2 to) {
        if (column < 0 || row < 0 || column >= tiles_.columns || row >= tiles_.rows) return;
        const std::int32_t slot = picture_.slots[tiles_.cellIndex(column, row)];
        if (slot < 0) return;
        const FieldSample* samples = &picture_.samples[static_cast<std::size_t>(slot) * kBlockRays];
        for (int y = 0; y < size.y; ++y) {
            float* out = &depths_[static_cast<std::size_t>((to.y + y) * kSide + to.x)];
            for (int x = 0; x < size.x; ++x) {
                const float depth = std::bit_cast<float>(samples[(from.y + y) * kTileSize + from.x + x].depthBits);
                out[x] = depth > 0.0F ? depth : kNothing;
            }
        }
    }

    const FieldPicture& picture_;
    const CellLists& tiles_;
    std::array<float, kSide * kSide> depths_;
};

// Four samples for each of these pixels, in their order, from `samples` on.
void castExtras(const FieldCast& cast, const Depths& depths, float radius, std::size_t tile, const TilePlaces& pixels,
                FieldSample* samples) {
    const glm::vec2 corner = cornerOf(*cast.tiles, tile);
    RayBlock block;
    block.count = 0;
    const auto flush = [&] {
        castBlock(cast, tile, block);
        PackedBlock packed;
        packBlock(cast.frame, block, cast.openness, packed);
        samples = std::copy_n(packed.begin(), block.count, samples);
        block.count = 0;
    };
    for (const std::uint8_t pixel : pixels) {
        const DepthRange range = depths.around(pixel, radius);
        for (const glm::vec2 offset : kFourSamples) {
            block.from[block.count] = range.from;
            block.to[block.count] = range.to;
            const glm::vec2 at = pixelMiddle(corner, pixel) + offset;
            block.x[block.count] = at.x;
            block.y[block.count] = at.y;
            ++block.count;
        }
        if (block.count == kBlockRays) flush();
    }
    if (block.count > 0) flush();
}

}  // namespace

void castOutlines(const FieldCast& cast, float radius, FieldPicture& picture) {
    const float jump = 0.5F * radius;
    picture.forSlots([&](std::size_t tile, std::size_t slot) {
        picture.outlines[slot].pixels = Depths(picture, *cast.tiles, tile).outlines(jump);
    });
    std::size_t end = picture.samples.size();
    for (Outlines& outlines : picture.outlines)
        outlines.first = std::exchange(end, end + kFourSamples.size() * outlines.pixels.size());
    picture.samples.resize(end);
    picture.forSlots([&](std::size_t tile, std::size_t slot) {
        const Outlines& outlines = picture.outlines[slot];
        if (outlines.pixels.size() > 0)
            castExtras(cast, Depths(picture, *cast.tiles, tile), radius, tile, outlines.pixels,
                       &picture.samples[outlines.first]);
    });
}

}  // namespace render
