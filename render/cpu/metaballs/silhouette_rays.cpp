// Outlines are told by the depths of pixels beside each other, which also tell where extra rays look.
#include "render/cpu/metaballs/silhouette_rays.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <utility>

#include "render/cpu/metaballs/ray_layout.h"
#include "render/cpu/metaballs/silhouette_marks.h"

namespace render {

namespace {

/// Where a pixel's extra rays look for the surface.
struct DepthRange {
    float from = 0.0F;
    float to = kEndless;
};

/// A bit for each of a pixel's samples that lies in this direction from its middle.
constexpr std::uint32_t samplesToward(glm::vec2 direction) {
    std::uint32_t bits = 0;
    for (std::size_t s = 0; s < kFourSamples.size(); ++s)
        bits |= std::uint32_t{kFourSamples[s].x * direction.x + kFourSamples[s].y * direction.y > 0.0F} << s;
    return bits;
}

// The depths of a tile's pixels and of those around them; kNothing where there is no surface.
class Depths {
 public:
    Depths(const FieldPicture& picture, const CellLists& tiles, std::size_t tile) : picture_(picture), tiles_(tiles) {
        const auto columns = static_cast<std::size_t>(tiles.columns);
        const int left = static_cast<int>(tile % columns);
        const int top = static_cast<int>(tile / columns);
        depths_.values.fill(kNothing);
        copy(left, top, {0, 0}, {kTileSize, kTileSize}, {1, 1});
        copy(left - 1, top, {kTileSize - 1, 0}, {1, kTileSize}, {0, 1});
        copy(left + 1, top, {0, 0}, {1, kTileSize}, {kTileSize + 1, 1});
        copy(left, top - 1, {0, kTileSize - 1}, {kTileSize, 1}, {1, 0});
        copy(left, top + 1, {0, 0}, {kTileSize, 1}, {1, kTileSize + 1});
    }

    // Samples of each pixel, a bit each, on the side of a pixel beside it whose depth differs by more than this; a hit
    // and a miss differ by more than any.
    std::array<std::uint32_t, kTilePixels> samplesAtOutlines(float jump) const {
        return marksOf(depths_, jump, kSides);
    }

    // Whether a sample of a pixel shows what its middle shows.
    bool isMiddles(std::uint8_t place, float depth, float jump) const {
        return std::abs(known(depth) - at(place)) <= jump;
    }

    // From a radius before the nearest of what the pixel and its neighbors show; where one of them shows nothing, to
    // two radii behind the farthest: what extra rays see is what the rays around them see.
    DepthRange around(std::uint8_t place, float radius) const {
        const float* at = &depths_.values[BorderedDepths::indexOf(place)];
        DepthRange range{kEndless, 0.0F};
        bool isOpen = false;
        for (const std::ptrdiff_t step : {std::ptrdiff_t{0}, std::ptrdiff_t{1}, std::ptrdiff_t{-1}, kSide, -kSide}) {
            const float depth = at[step];
            isOpen = isOpen || depth == kNothing;
            range.from = depth > 0.0F ? std::min(range.from, depth - radius) : range.from;
            range.to = std::max(range.to, depth + 2.0F * radius);
        }
        return isOpen ? range : DepthRange{range.from, kEndless};
    }

 private:
    static constexpr std::ptrdiff_t kSide = BorderedDepths::kSide;

    // A neighbor, and the samples that lie toward it.
    static constexpr std::array<MarkedSide, 4> kSides = {{{1, samplesToward({1.0F, 0.0F})},
                                                          {-1, samplesToward({-1.0F, 0.0F})},
                                                          {kSide, samplesToward({0.0F, 1.0F})},
                                                          {-kSide, samplesToward({0.0F, -1.0F})}}};

    static constexpr float kNothing = -1e30F;  // farther than any jump from what is seen

    static float known(float depth) { return depth > 0.0F ? depth : kNothing; }

    float at(std::uint8_t place) const { return depths_.values[BorderedDepths::indexOf(place)]; }

    void copy(int column, int row, glm::ivec2 from, glm::ivec2 size, glm::ivec2 to) {
        if (column < 0 || row < 0 || column >= tiles_.columns || row >= tiles_.rows) return;
        const std::int32_t slot = picture_.slots[tiles_.cellIndex(column, row)];
        if (slot < 0) return;
        const auto depths = picture_.depthsOf(static_cast<std::size_t>(slot));
        for (int y = 0; y < size.y; ++y) {
            float* out = &depths_.values[static_cast<std::size_t>((to.y + y) * kSide + to.x)];
            const float* own = &depths[static_cast<std::size_t>((from.y + y) * kTileSize + from.x)];
            for (int x = 0; x < size.x; ++x) out[x] = known(own[x]);
        }
    }

    const FieldPicture& picture_;
    const CellLists& tiles_;
    BorderedDepths depths_;
};

class OutlineCast {
 public:
    OutlineCast(const FieldCast& cast, float radius, const FieldPicture& picture, std::size_t tile, Outlines& outlines)
        : cast_(cast),
          radius_(radius),
          tile_(tile),
          corner_(tileCorner(*cast.tiles, tile)),
          depths_(picture, *cast.tiles, tile),
          outlines_(outlines) {
        block_.count = 0;
    }

    void run() {
        const std::array<std::uint32_t, kTilePixels> samples = depths_.samplesAtOutlines(jump());
        std::array<bool, kBlockRays> isAtOutline;
        for (std::size_t k = 0; k < kBlockRays; ++k) isAtOutline[k] = samples[k] != 0;
        for (const std::uint8_t pixel : placesWhere(isAtOutline)) {
            const DepthRange range = depths_.around(pixel, radius_);
            for (std::uint32_t left = samples[pixel]; left != 0; left &= left - 1)
                add({pixel, static_cast<std::uint8_t>(std::countr_zero(left))}, range);
        }
        flush();
    }

 private:
    float jump() const { return 0.5F * radius_; }

    void add(OutlineSample sample, DepthRange range) {
        const glm::vec2 at = pixelMiddle(corner_, sample.pixel) + kFourSamples[sample.sample];
        const std::size_t k = block_.count++;
        samples_[k] = sample;
        block_.from[k] = range.from;
        block_.to[k] = range.to;
        block_.x[k] = at.x;
        block_.y[k] = at.y;
        if (block_.count == kBlockRays) flush();
    }

    void flush() {
        castBlock(cast_, tile_, block_);
        PackedBlock packed;
        packBlock(cast_.frame, block_, cast_.skyVisibility, packed.data());
        for (std::size_t k = 0; k < block_.count; ++k) {
            if (depths_.isMiddles(samples_[k].pixel, packed[k].depth(), jump())) continue;
            outlines_.samples.push_back(samples_[k]);
            outlines_.shown.push_back(packed[k]);
        }
        block_.count = 0;
    }

    const FieldCast& cast_;
    float radius_;
    std::size_t tile_;
    glm::vec2 corner_;
    Depths depths_;
    Outlines& outlines_;
    RayBlock block_;
    std::array<OutlineSample, kBlockRays> samples_;
};

}  // namespace

void castOutlines(const FieldCast& cast, float radius, FieldPicture& picture) {
    picture.forSlots([&](std::size_t tile, std::size_t slot) {
        OutlineCast(cast, radius, picture, tile, picture.outlines[slot]).run();
    });
    std::size_t end = picture.depths.size();
    for (Outlines& outlines : picture.outlines) outlines.first = std::exchange(end, end + outlines.shown.size());
    picture.samples.resize(std::max(picture.samples.size(), end));
    for (const Outlines& outlines : picture.outlines)
        std::ranges::copy(outlines.shown, picture.samples.begin() + static_cast<std::ptrdiff_t>(outlines.first));
}

}  // namespace render
