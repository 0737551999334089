// Lines over a tile: antialiased, of constant width in pixels, hidden by what is nearer than they are. Called by
// picture_colors.cpp.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include <glm/glm.hpp>

#include "render/cpu/raster/line_list.h"
#include "render/cpu/raster/primary_hits.h"

namespace render {

/// What is laid over each pixel of a tile, row by row: the color times its share of the pixel, and in w the share.
using LineCoverage = std::array<glm::vec4, kTilePixels>;

/// @param samples  the primary hits of the tile
/// @param point    where in each pixel the coverage is measured, from the pixel's corner
LineCoverage lineCoverage(const SolidGeometry& geometry, const LineList& lines, std::size_t tile,
                          std::span<const TileRays> samples, glm::vec2 point);

}  // namespace render
