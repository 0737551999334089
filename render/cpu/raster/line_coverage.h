// Lines over a tile: antialiased, of constant width in pixels, hidden by what is nearer than they are. Called by
// picture_samples.cpp.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include <glm/glm.hpp>

#include "render/cpu/raster/line_list.h"
#include "render/cpu/raster/primary_hits.h"

namespace render {

/// What is laid over each pixel of a tile: a color times its share of the pixel; w: the share.
using LineCover = std::array<glm::vec4, kTilePixels>;

/// samples: what the tile's rays see; where: of the line within the pixel, from its corner.
LineCover lineCover(const Solids& solids, const LineList& lines, std::size_t tile, std::span<const TileRays> samples,
                    glm::vec2 where);

}  // namespace render
