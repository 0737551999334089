// Samples of a pixel that hit different triangles of one smooth surface, for which shading the pixel once is enough.
// Called by tile_samples.cpp.
#pragma once

#include <span>

#include "render/cpu/raster/mesh_tiles.h"
#include "render/cpu/raster/primary_hits.h"

namespace render {

/// Gives samples of a pixel that hit triangles of one smooth surface the same hit id, of one of these triangles, so
/// that the pixel is no edge pixel. What a pixel gets depends on its own samples alone, bit for bit, not on the
/// instruction set.
/// @param samples  four
void mergeSmoothHits(const SolidGeometry& geometry, std::span<TileRays> samples);

}  // namespace render
