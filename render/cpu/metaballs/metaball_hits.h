// What the metaball rays of a picture hit: packed to 16 bytes per ray, tile by tile, with extra samples at silhouettes.
// Written by metaball_frame.cpp and silhouette_rays.cpp, read by tile_samples.cpp and shading_points.cpp.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <tbb/parallel_for.h>

#include "render/cpu/metaballs/metaball_cast.h"
#include "render/cpu/metaballs/ray_interpolation.h"

namespace render {

/// What one ray hits, packed into 16 bytes.
struct PackedHit {
    std::uint32_t depthBits;  ///< view depth of the hit in m, as the bits of a float; 0 without a hit
    std::uint32_t normal;     ///< unit normal in world axes, in octahedral encoding with 16 + 16 bits
    std::uint32_t color;      ///< square roots of linear red, green and blue: 11 + 11 + 10 bits, red the lowest
    std::uint32_t sky;        ///< sky visibility along the normal, against it and along the mirrored ray: 10 bits each

    float depth() const { return std::bit_cast<float>(depthBits); }
};

/// Packs the rays of a block that was cast in this scene, with the same bits on every instruction set.
/// @param packed  room for kTilePixels hits; entries beyond the block's count have no meaning
void packHits(const MetaballScene& scene, const RayBlock& block, PackedHit* packed);

/// A sample of a pixel that hits something else than the ray through the pixel's middle.
struct SilhouetteSample {
    std::uint8_t pixel;   ///< the pixel as column + 16 row of the tile
    std::uint8_t sample;  ///< index of the sample in kFourSamples
};

/// The extra samples at the silhouettes in one tile, and what they hit.
struct SilhouetteHits {
    std::vector<SilhouetteSample> samples;
    std::vector<PackedHit> hits;  ///< hit of each sample
    std::size_t firstIndex = 0;   ///< index in MetaballHits::hits of the first of these hits
};

/// The hits of one picture. Tiles that show metaballs have slots, which are numbered from 0; other tiles take no
/// memory.
struct MetaballHits {
    std::vector<std::int32_t> slots;  ///< slot of each tile; -1 for a tile that shows no metaballs
    std::vector<PackedHit> hits;      ///< hits of the 256 pixels of each slot, row by row, then hits of extra samples
    std::vector<float> depths;        ///< view depths of the 256 hits of each slot, m; 0 without a hit
    std::vector<SilhouetteHits> silhouettes;  ///< extra samples of each slot
    std::vector<CoarseHits> coarse;  ///< hits of the cast rays of each slot, which others are interpolated from

    /// Makes room for a number of slots. Memory is not freed, so that the next picture need not allocate it again.
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

    /// Calls visit(tile, slot) for each tile that has a slot, in parallel.
    template <typename Visit>
    void forEachSlot(const Visit& visit) const {
        tbb::parallel_for(std::size_t{0}, slots.size(), [&](std::size_t tile) {
            if (slots[tile] >= 0) visit(tile, static_cast<std::size_t>(slots[tile]));
        });
    }
};

}  // namespace render
