// What rays through the pixels of a tile meet first of the triangles of mesh obstacles, as many rays at a time as a
// SIMD vector holds. Called by tile_samples.cpp and lines.cpp.
#pragma once

#include <cstddef>
#include <span>

#include "render/cpu/raster/mesh_tiles.h"
#include "render/cpu/raster/primary_hits.h"

namespace render {

// The functions below give a ray a hit that depends on its own position alone, bit for bit, not on the instruction set.
// No ray passes between two triangles that share an edge and lie before the eye.

/// Replaces the rays' hits by nearer ones of the triangles of a tile.
/// @pre the rays of a sample go through the same point of each pixel
void findMeshHits(const SolidGeometry& geometry, std::size_t tile, std::span<TileRays> samples);

/// Replaces the rays' hits by nearer ones of the triangles of a tile, for rays that may pass beside the tile by as much
/// as the triangles were listed with.
void findMeshHitsAnywhere(const SolidGeometry& geometry, std::size_t tile, TileRays& rays);

}  // namespace render
