// Silhouettes are found from the depths of neighboring pixels, which also bound the depths of the extra rays.
#include "render/cpu/metaballs/silhouette_rays.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "render/cpu/metaballs/ray_layout.h"

namespace render {

namespace {

/// View depths between which the extra rays of a pixel search for the surface, m.
struct DepthRange {
    float low = 0.0F;
    float high = kNoDepthLimit;
};

/// Bit mask of the samples of a pixel that lie in this direction from the pixel's middle.
constexpr std::uint32_t samplesToward(glm::vec2 direction) {
    std::uint32_t bits = 0;
    for (std::size_t s = 0; s < kFourSamples.size(); ++s)
        bits |= std::uint32_t{kFourSamples[s].x * direction.x + kFourSamples[s].y * direction.y > 0.0F} << s;
    return bits;
}

/// The view depths of a tile's pixels and of their neighbors around the tile, row by row; kNoSurface for pixels that
/// show no surface. The four corners are not used.
class TileDepths {
 public:
    TileDepths(const MetaballHits& hits, const CellLists& tiles, std::size_t tile) : hits_(hits), tiles_(tiles) {
        const auto columns = static_cast<std::size_t>(tiles.columns);
        const int left = static_cast<int>(tile % columns);
        const int top = static_cast<int>(tile / columns);
        depths_.fill(kNoSurface);
        copy(left, top, {0, 0}, {kTileSize, kTileSize}, {1, 1});
        copy(left - 1, top, {kTileSize - 1, 0}, {1, kTileSize}, {0, 1});
        copy(left + 1, top, {0, 0}, {1, kTileSize}, {kTileSize + 1, 1});
        copy(left, top - 1, {0, kTileSize - 1}, {kTileSize, 1}, {1, 0});
        copy(left, top + 1, {0, 0}, {kTileSize, 1}, {1, kTileSize + 1});
    }

    /// A bit for each of a pixel's samples toward a neighbor whose depth differs by more than `jump`. The depths of a
    /// hit and a miss always do.
    std::array<std::uint32_t, kTilePixels> samplesAtSilhouettes(float jump) const {
        std::array<std::uint32_t, kTilePixels> samples{};
        for (std::size_t row = 0; row < kTileSize; ++row) {
            const float* own = &depths_[indexOf(static_cast<std::uint8_t>(row * kTileSize))];
            std::uint32_t* found = &samples[row * kTileSize];
            for (std::ptrdiff_t k = 0; k < kTileSize; ++k) {  // without branches: compilers vectorize this loop
                const auto toward = [&](const NeighborSide& side) {
                    return std::abs(own[k + side.step] - own[k]) > jump ? side.sampleMask : 0U;
                };
                found[k] = toward(kSides[0]) | toward(kSides[1]) | toward(kSides[2]) | toward(kSides[3]);
            }
        }
        return samples;
    }

    /// Whether a sample of this depth shows the surface that its pixel's middle shows.
    bool isSameSurface(std::uint8_t pixel, float depth, float jump) const {
        return std::abs(markMiss(depth) - depths_[indexOf(pixel)]) <= jump;
    }

    /// The extra rays of a pixel search from one radius before the nearest depth of the pixel and its neighbors. Where
    /// one of these shows no surface, they search to two radii behind the farthest, because they are to see no more
    /// than the rays around them see.
    DepthRange rangeAround(std::uint8_t pixel, float radius) const {
        const float* at = &depths_[indexOf(pixel)];
        DepthRange range{kNoDepthLimit, 0.0F};
        bool isOpen = false;
        for (const std::ptrdiff_t step : {std::ptrdiff_t{0}, std::ptrdiff_t{1}, std::ptrdiff_t{-1}, kSide, -kSide}) {
            const float depth = at[step];
            isOpen = isOpen || depth == kNoSurface;
            range.low = depth > 0.0F ? std::min(range.low, depth - radius) : range.low;
            range.high = std::max(range.high, depth + 2.0F * radius);
        }
        return isOpen ? range : DepthRange{range.low, kNoDepthLimit};
    }

 private:
    static constexpr std::ptrdiff_t kSide = kTileSize + 2;

    struct NeighborSide {
        std::ptrdiff_t step;       // difference in index from a pixel to its neighbor
        std::uint32_t sampleMask;  // bit mask of the pixel's samples toward the neighbor
    };
    static constexpr std::array<NeighborSide, 4> kSides = {{{1, samplesToward({1.0F, 0.0F})},
                                                            {-1, samplesToward({-1.0F, 0.0F})},
                                                            {kSide, samplesToward({0.0F, 1.0F})},
                                                            {-kSide, samplesToward({0.0F, -1.0F})}}};

    static constexpr float kNoSurface = -1e30F;  // differs from every depth by more than any jump

    static std::size_t indexOf(std::uint8_t pixel) {
        return static_cast<std::size_t>((pixel / kTileSize + 1) * kSide + pixel % kTileSize + 1);
    }

    static float markMiss(float depth) { return depth > 0.0F ? depth : kNoSurface; }

    /// Copies a rectangle of the tile in this column and row.
    void copy(int column, int row, glm::ivec2 from, glm::ivec2 size, glm::ivec2 to) {
        if (column < 0 || row < 0 || column >= tiles_.columns || row >= tiles_.rows) return;
        const std::int32_t slot = hits_.slots[tiles_.cellIndex(column, row)];
        if (slot < 0) return;
        const auto depths = hits_.depthsOf(static_cast<std::size_t>(slot));
        for (int y = 0; y < size.y; ++y) {
            float* out = &depths_[static_cast<std::size_t>((to.y + y) * kSide + to.x)];
            const float* in = &depths[static_cast<std::size_t>((from.y + y) * kTileSize + from.x)];
            for (int x = 0; x < size.x; ++x) out[x] = markMiss(in[x]);
        }
    }

    const MetaballHits& hits_;
    const CellLists& tiles_;
    std::array<float, kSide * kSide> depths_;
};

/// Casts the extra rays of one tile, a block at a time.
class SilhouetteCast {
 public:
    SilhouetteCast(const MetaballScene& scene, const MetaballHits& hits, std::size_t tile, SilhouetteHits& found)
        : scene_(scene),
          tile_(tile),
          corner_(tileCorner(scene.tiles, tile)),
          depths_(hits, scene.tiles, tile),
          found_(found) {
        block_.count = 0;
    }

    void run() {
        const std::array<std::uint32_t, kTilePixels> samples = depths_.samplesAtSilhouettes(jump());
        std::array<bool, kTilePixels> isAtSilhouette;
        for (std::size_t k = 0; k < kTilePixels; ++k) isAtSilhouette[k] = samples[k] != 0;
        for (const std::uint8_t pixel : pixelsWhere(isAtSilhouette)) {
            const DepthRange range = depths_.rangeAround(pixel, scene_.smallestRadius);
            for (std::uint32_t bits = samples[pixel]; bits != 0; bits &= bits - 1)
                add({pixel, static_cast<std::uint8_t>(std::countr_zero(bits))}, range);
        }
        flush();
    }

 private:
    float jump() const { return 0.5F * scene_.smallestRadius; }

    void add(SilhouetteSample sample, DepthRange range) {
        const glm::vec2 at = pixelMiddle(corner_, sample.pixel) + kFourSamples[sample.sample];
        const std::size_t k = block_.count++;
        samples_[k] = sample;
        block_.minDepth[k] = range.low;
        block_.maxDepth[k] = range.high;
        block_.x[k] = at.x;
        block_.y[k] = at.y;
        if (block_.count == kTilePixels) flush();
    }

    void flush() {
        castBlock(scene_, tile_, block_);
        std::array<PackedHit, kTilePixels> packed;
        packHits(scene_, block_, packed.data());
        for (std::size_t k = 0; k < block_.count; ++k) {
            if (depths_.isSameSurface(samples_[k].pixel, packed[k].depth(), jump())) continue;
            found_.samples.push_back(samples_[k]);
            found_.hits.push_back(packed[k]);
        }
        block_.count = 0;
    }

    const MetaballScene& scene_;
    std::size_t tile_;
    glm::vec2 corner_;
    TileDepths depths_;
    SilhouetteHits& found_;
    RayBlock block_;
    std::array<SilhouetteSample, kTilePixels> samples_;
};

}  // namespace

void castSilhouettes(const MetaballScene& scene, MetaballHits& hits) {
    hits.forEachSlot(
        [&](std::size_t tile, std::size_t slot) { SilhouetteCast(scene, hits, tile, hits.silhouettes[slot]).run(); });
    std::size_t end = hits.depths.size();
    for (SilhouetteHits& one : hits.silhouettes) one.firstIndex = std::exchange(end, end + one.hits.size());
    hits.hits.resize(std::max(hits.hits.size(), end));
    for (const SilhouetteHits& one : hits.silhouettes)
        std::ranges::copy(one.hits, hits.hits.begin() + static_cast<std::ptrdiff_t>(one.firstIndex));
}

}  // namespace render
