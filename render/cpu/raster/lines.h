// The edges of a view as straight lines on the picture: antialiased, of constant width in pixels, hidden by what is
// nearer than they are. Drawn over tiles by picture_colors.cpp.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include <glm/glm.hpp>

#include "render/cpu/raster/primary_hits.h"
#include "render/picture/camera_frame.h"
#include "render/prepare/cells/tiles.h"
#include "render/prepare/screen_lines.h"

namespace render {

/// For each pixel of a tile, row by row: in w the share of the pixel that lines cover, and in xyz their color times
/// that share.
using LineCoverage = std::array<glm::vec4, kTilePixels>;

/// Computes how much of each pixel of a tile lines cover, where nothing nearer hides them.
/// @param samples  the primary hits of the tile
/// @param point    position in each pixel at which the coverage is measured, from the pixel's corner, pixels
LineCoverage lineCoverage(const SolidGeometry& geometry, const LineList& lines, std::size_t tile,
                          std::span<const TileRays> samples, glm::vec2 point);

}  // namespace render
