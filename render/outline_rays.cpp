// Pixels that outlines cross are told by the depths of those around them, which also tell where their rays look.
#include "render/outline_rays.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <utility>
#include <vector>

#include <tbb/parallel_for.h>

#include "render/ray_places.h"

namespace render {

namespace {

/// Where a pixel's extra rays look for the surface.
struct DepthRange {
    float from = 0.0F;
    float to = kEndless;
};

// The depths of a tile's pixels and of those around them; 0 where there is no surface.
class Depths {
 public:
    Depths(const FieldPicture& picture, const CellLists& tiles, std::size_t tile) : picture_(picture), tiles_(tiles) {
        const auto columns = static_cast<std::size_t>(tiles.columns);
        const int left = static_cast<int>(tile % columns);
        const int top = static_cast<int>(tile / columns);
        copy(left, top, {0, 0}, {kTileSize, kTileSize}, {1, 1});
        copy(left - 1, top, {kTileSize - 1, 0}, {1, kTileSize}, {0, 1});
        copy(left + 1, top, {0, 0}, {1, kTileSize}, {kTileSize + 1, 1});
        copy(left, top - 1, {0, kTileSize - 1}, {kTileSize, 1}, {1, 0});
        copy(left, top + 1, {0, 0}, {kTileSize, 1}, {1, kTileSize + 1});
    }

    // Hit beside miss, or a jump in depth that a pixel's slope does not explain.
    std::array<bool, kBlockRays> outlines(float jump) const {
        std::array<bool, kBlockRays> found{};
        for (std::size_t row = 0; row < kTileSize; ++row) {
            const float* at = &depths_[(row + 1) * kSide + 1];
            bool* out = &found[row * kTileSize];
            for (const std::ptrdiff_t step : {std::ptrdiff_t{1}, std::ptrdiff_t{-1}, kSide, -kSide})
                for (std::ptrdiff_t k = 0; k < kTileSize; ++k) out[k] = out[k] | differs(at[k], at[k + step], jump);
        }
        return found;
    }

    // From a radius before the nearest of what the pixel and its neighbours show; where one of them shows nothing, to
    // two radii behind the farthest: what extra rays see is what the rays around them see.
    DepthRange around(std::uint8_t place, float radius) const {
        const std::ptrdiff_t at = (place / kTileSize + 1) * kSide + place % kTileSize + 1;
        DepthRange range{kEndless, 0.0F};
        bool isOpen = false;
        for (const std::ptrdiff_t step : {std::ptrdiff_t{0}, std::ptrdiff_t{1}, std::ptrdiff_t{-1}, kSide, -kSide}) {
            const float depth = depths_[static_cast<std::size_t>(at + step)];
            isOpen = isOpen || depth <= 0.0F;
            range.from = depth > 0.0F ? std::min(range.from, depth - radius) : range.from;
            range.to = std::max(range.to, depth + 2.0F * radius);
        }
        return isOpen ? range : DepthRange{range.from, kEndless};
    }

 private:
    static constexpr std::ptrdiff_t kSide = kTileSize + 2;

    static bool differs(float depth, float other, float jump) {
        return ((other > 0.0F) != (depth > 0.0F)) | (std::abs(other - depth) > jump);
    }

    void copy(int column, int row, glm::ivec2 from, glm::ivec2 size, glm::ivec2 to) {
        if (column < 0 || row < 0 || column >= tiles_.columns || row >= tiles_.rows) return;
        const std::int32_t slot = picture_.slots[tiles_.cellIndex(column, row)];
        if (slot < 0) return;
        const FieldSample* samples = &picture_.samples[static_cast<std::size_t>(slot) * kBlockRays];
        for (int y = 0; y < size.y; ++y)
            for (int x = 0; x < size.x; ++x)
                depths_[static_cast<std::size_t>((to.y + y) * kSide + to.x + x)] =
                    std::bit_cast<float>(samples[(from.y + y) * kTileSize + from.x + x].depthBits);
    }

    const FieldPicture& picture_;
    const CellLists& tiles_;
    std::array<float, kSide * kSide> depths_{};
};

// The extra samples of one tile, in the order of its pixels.
struct TileExtras {
    std::vector<std::uint8_t> pixels;
    std::vector<FieldSample> samples;  ///< four a pixel
};

TileExtras castExtras(const FieldCast& cast, const Depths& depths, float radius, std::size_t tile,
                      std::vector<std::uint8_t> pixels) {
    TileExtras extras;
    const glm::vec2 corner = cornerOf(*cast.tiles, tile);
    RayBlock block;
    const auto flush = [&] {
        castBlock(cast, tile, block);
        PackedBlock packed;
        packBlock(cast.frame, block, cast.openness, packed);
        const auto count = static_cast<std::ptrdiff_t>(block.count);
        extras.samples.insert(extras.samples.end(), packed.begin(), packed.begin() + count);
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
    extras.pixels = std::move(pixels);
    return extras;
}

}  // namespace

void castOutlines(const FieldCast& cast, float radius, FieldPicture& picture) {
    const float jump = 0.5F * radius;
    std::vector<TileExtras> extras(picture.slots.size());
    tbb::parallel_for(std::size_t{0}, picture.slots.size(), [&](std::size_t tile) {
        if (picture.slots[tile] < 0) return;
        const Depths depths(picture, *cast.tiles, tile);
        const std::array<bool, kBlockRays> outlines = depths.outlines(jump);
        std::vector<std::uint8_t> pixels;
        for (const std::uint8_t place : kZCurve)
            if (outlines[place]) pixels.push_back(place);
        if (!pixels.empty()) extras[tile] = castExtras(cast, depths, radius, tile, std::move(pixels));
    });
    std::vector<std::size_t> first(extras.size());
    std::size_t end = picture.samples.size();
    for (std::size_t tile = 0; tile < extras.size(); ++tile)
        first[tile] = std::exchange(end, end + extras[tile].samples.size());
    picture.samples.resize(end);
    tbb::parallel_for(std::size_t{0}, extras.size(), [&](std::size_t tile) {
        const TileExtras& own = extras[tile];
        if (own.pixels.empty()) return;
        std::ranges::copy(own.samples, &picture.samples[first[tile]]);
        const std::size_t base = static_cast<std::size_t>(picture.slots[tile]) * kBlockRays;
        for (std::size_t k = 0; k < own.pixels.size(); ++k)
            picture.extras[base + own.pixels[k]] = static_cast<std::uint32_t>(first[tile] + 4 * k);
    });
}

}  // namespace render
