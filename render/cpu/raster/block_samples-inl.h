// The samples of a tile in the order in which triangles are drawn. Made for mesh_hits.cpp. Included by Highway's rules,
// from which the guard below comes.
#if defined(RENDER_BLOCK_SAMPLES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef RENDER_BLOCK_SAMPLES_INL_H_
#undef RENDER_BLOCK_SAMPLES_INL_H_
#else
#define RENDER_BLOCK_SAMPLES_INL_H_
#endif

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include <hwy/highway.h>

#include "render/cpu/raster/primary_hits.h"
#include "render/prepare/cells/simd_rays-inl.h"

HWY_BEFORE_NAMESPACE();
namespace render {
namespace HWY_NAMESPACE {

constexpr std::size_t kBlock = 16;  ///< samples in a block

using BlockValues = std::array<float, kBlock>;  ///< a number for each sample of a block

/// The samples of a tile, one block of pixels after another: 16 samples each, those of 2 x 2 pixels with four samples
/// or of 4 x 4 pixels with a single one. A small triangle touches few such blocks, and a vector takes many of its
/// samples.
/// @tparam kSide  of a block, pixels
template <int kSide>
struct BlockSamples {
    static constexpr std::size_t kSamples = kBlock / (kSide * kSide);
    static constexpr int kBlocksInRow = kTileSize / kSide;

    alignas(64) std::array<float, kSamples * kTilePixels> depth;
    alignas(64) std::array<std::int32_t, kSamples * kTilePixels> hitId;

    explicit BlockSamples(std::span<const TileRays> samples) {
        forRuns([&](std::size_t s, std::size_t inBlocks, std::size_t inRows) {
            std::copy_n(&samples[s].depth[inRows], kSide, &depth[inBlocks]);
            std::copy_n(&samples[s].hitId[inRows], kSide, &hitId[inBlocks]);
        });
    }

    void copyTo(std::span<TileRays> samples) const {
        forRuns([&](std::size_t s, std::size_t inBlocks, std::size_t inRows) {
            std::copy_n(&depth[inBlocks], kSide, &samples[s].depth[inRows]);
            std::copy_n(&hitId[inBlocks], kSide, &samples[s].hitId[inRows]);
        });
    }

    /// Index of a block's first sample.
    static std::size_t blockAt(int column, int row) {
        return static_cast<std::size_t>(row * kBlocksInRow + column) * kBlock;
    }

    float farthest() const {
        const D d;
        V most = load(depth.data());
        for (std::size_t first = hn::Lanes(d); first < depth.size(); first += hn::Lanes(d))
            most = hn::Max(most, load(&depth[first]));
        return hn::GetLane(hn::MaxOfLanes(d, most));
    }

 private:
    /// Calls visit(sample, index in the blocks, index in the rows of the tile) for the first pixel of each row of each
    /// block.
    template <typename Visit>
    static void forRuns(const Visit& visit) {
        for (std::size_t s = 0; s < kSamples; ++s) {
            for (std::size_t row = 0; row < kTileSize; ++row) {
                const std::size_t inBlock = (s * kSide + row % kSide) * kSide;
                for (std::size_t across = 0; across < kBlocksInRow; ++across)
                    visit(s, (row / kSide * kBlocksInRow + across) * kBlock + inBlock,
                          row * kTileSize + across * kSide);
            }
        }
    }
};

/// Where the samples of a block lie: column and row of their pixels from the block's corner, and their offsets from the
/// corner of their pixels.
template <int kSide>
struct BlockPlaces {
    alignas(64) BlockValues column, row, offsetX, offsetY;

    /// @param corner  of the tile, pixels
    BlockPlaces(glm::vec2 corner, std::span<const TileRays> samples) {
        for (std::size_t k = 0; k < kBlock; ++k) {
            const TileRays& rays = samples[k / (kSide * kSide)];
            column[k] = static_cast<float>(k % kSide);
            row[k] = static_cast<float>(k / kSide % kSide);
            offsetX[k] = rays.x[0] - corner.x;
            offsetY[k] = rays.y[0] - corner.y;
        }
    }
};

}  // namespace HWY_NAMESPACE
}  // namespace render
HWY_AFTER_NAMESPACE();

#endif
