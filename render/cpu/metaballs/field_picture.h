// The metaballs of one picture, as they are handed from stage to stage: what rays met, tile by tile.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <hwy/cache_control.h>
#include <tbb/parallel_for.h>

#include "render/cpu/metaballs/metaball_sample.h"
#include "render/cpu/metaballs/ray_interpolation.h"

namespace render {

/// A sample of a pixel that shows something else than the pixel's middle.
struct OutlineSample {
    std::uint8_t pixel;   ///< column + 16 row of the tile
    std::uint8_t sample;  ///< of kFourSamples
};

/// What outlines show of a tile.
struct Outlines {
    std::vector<OutlineSample> samples;
    std::vector<FieldSample> shown;  ///< by each of these
    std::size_t first = 0;           ///< their place in FieldPicture::samples
};

struct FieldPicture {
    std::vector<std::int32_t> slots;   ///< per tile; -1 where nothing of the surface is seen
    std::vector<FieldSample> samples;  ///< 256 a slot, row by row, then those of outlines
    std::vector<float> depths;         ///< 256 a slot: of its samples, which are larger; 0: no surface
    std::vector<Outlines> outlines;    ///< per slot
    std::vector<CoarseHits> coarse;    ///< per slot: what samples between were made from

    /// Room for so many slots; never less than before, so that nothing is made anew in the next picture.
    void makeRoom(std::size_t slotCount) {
        if (slotCount > outlines.size()) outlines.resize(slotCount);
        depths.resize(outlines.size() * kBlockRays);
        samples.resize(std::max(samples.size(), depths.size()));
        for (Outlines& one : outlines) {
            one.samples.clear();
            one.shown.clear();
        }
    }

    std::span<const float, kBlockRays> depthsOf(std::size_t slot) const {
        return std::span<const float, kBlockRays>(&depths[slot * kBlockRays], kBlockRays);
    }

    /// Tells the caches that a slot's samples will be asked for soon, in any order.
    void fetch(std::size_t slot) const {
        constexpr std::size_t kALine = 64 / sizeof(FieldSample);
        const FieldSample* first = &samples[slot * kBlockRays];
        for (std::size_t k = 0; k < kBlockRays; k += kALine) hwy::Prefetch(first + k);
    }

    /// visit(tile, slot) for each tile that has one, by all threads.
    template <typename Visit>
    void forSlots(const Visit& visit) const {
        tbb::parallel_for(std::size_t{0}, slots.size(), [&](std::size_t tile) {
            if (slots[tile] >= 0) visit(tile, static_cast<std::size_t>(slots[tile]));
        });
    }
};

}  // namespace render
