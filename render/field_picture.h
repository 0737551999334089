// The metaballs of one picture, as they are handed from stage to stage: what rays met, tile by tile.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <tbb/parallel_for.h>

#include "render/field_between.h"
#include "render/field_sample.h"
#include "render/ray_places.h"

namespace render {

/// The pixels of a tile that have four more samples each, at the sub-pixel places.
struct Outlines {
    TilePlaces pixels;
    std::size_t first = 0;  ///< place of their samples, pixel after pixel
};

struct FieldPicture {
    std::vector<FieldSample> samples;  ///< 256 a slot, row by row, then those of outlines
    std::vector<std::int32_t> slots;   ///< per tile; -1 where nothing of the surface is seen
    std::vector<Outlines> outlines;    ///< per slot
    std::vector<CoarseHits> coarse;    ///< per slot: what samples between were made from

    /// visit(tile, slot) for each tile that has one, by all threads.
    template <typename Visit>
    void forSlots(const Visit& visit) const {
        tbb::parallel_for(std::size_t{0}, slots.size(), [&](std::size_t tile) {
            if (slots[tile] >= 0) visit(tile, static_cast<std::size_t>(slots[tile]));
        });
    }
};

}  // namespace render
