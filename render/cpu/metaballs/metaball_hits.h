// What the metaball rays of a picture hit: packed to 16 bytes per ray, tile by tile, with extra samples at silhouettes.
// Written by metaball_frame.cpp and silhouette_rays.cpp, read by tile_samples.cpp and shading_points.cpp.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <hwy/cache_control.h>
#include <tbb/parallel_for.h>

#include "render/cpu/metaballs/metaball_cast.h"
#include "render/cpu/metaballs/ray_interpolation.h"

namespace render {

/// A point of the surface.
struct PackedHit {
    std::uint32_t depthBits;  ///< view depth, the bits of a float; 0: no surface
    std::uint32_t normal;     ///< octahedral, 16 + 16 bits, in world axes
    std::uint32_t color;      ///< square roots, 11 + 11 + 10 bits
    std::uint32_t sky;        ///< visibility along the normal, against it and along the mirrored ray, 10 bits each

    float depth() const { return std::bit_cast<float>(depthBits); }
};

/// Packs the rays of a block that was cast in this scene, with the same bits on every instruction set.
/// @param packed  room for kTilePixels; entries beyond the block's count have no meaning
void packHits(const MetaballScene& scene, const RayBlock& block, PackedHit* packed);

/// A sample of a pixel that hits something else than the ray through the pixel's middle.
struct SilhouetteSample {
    std::uint8_t pixel;   ///< column + 16 row of the tile
    std::uint8_t sample;  ///< index in kFourSamples
};

struct SilhouetteHits {
    std::vector<SilhouetteSample> samples;
    std::vector<PackedHit> hits;  ///< of each of these samples
    std::size_t firstIndex = 0;   ///< of their copies in MetaballHits::hits
};

/// Tiles that show no metaballs take no memory: the others have slots, numbered from 0.
struct MetaballHits {
    std::vector<std::int32_t> slots;          ///< of each tile; -1 where nothing of the surface is seen
    std::vector<PackedHit> hits;              ///< 256 per slot, row by row, then those of silhouettes
    std::vector<float> depths;                ///< 256 per slot: the depths of its hits; 0: no surface
    std::vector<SilhouetteHits> silhouettes;  ///< per slot
    std::vector<CoarseHits> coarse;           ///< per slot: the hits that the others were interpolated from

    /// Never shrinks, so that nothing is allocated again for the next picture.
    void reserve(std::size_t slotCount) {
        if (slotCount > silhouettes.size()) silhouettes.resize(slotCount);
        depths.resize(silhouettes.size() * kTilePixels);
        hits.resize(std::max(hits.size(), depths.size()));
        for (SilhouetteHits& one : silhouettes) {
            one.samples.clear();
            one.hits.clear();
        }
    }

    std::span<const float, kTilePixels> depthsOf(std::size_t slot) const {
        return std::span<const float, kTilePixels>(&depths[slot * kTilePixels], kTilePixels);
    }

    /// Loads a slot's hits into the caches; they will be read soon, in any order.
    void prefetch(std::size_t slot) const {
        constexpr std::size_t kHitsPerCacheLine = 64 / sizeof(PackedHit);
        const PackedHit* first = &hits[slot * kTilePixels];
        for (std::size_t k = 0; k < kTilePixels; k += kHitsPerCacheLine) hwy::Prefetch(first + k);
    }

    /// Calls visit(tile, slot) for each tile that has a slot, in parallel.
    template <typename Visit>
    void forEachSlot(const Visit& visit) const {
        tbb::parallel_for(std::size_t{0}, slots.size(), [&](std::size_t tile) {
            if (slots[tile] >= 0) visit(tile, static_cast<std::size_t>(slots[tile]));
        });
    }
};

}  // namespace render
