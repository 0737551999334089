// The edges of a view as straight lines on the picture: antialiased, of constant width in pixels, hidden by what is
// nearer than they are. Projected by the picture pass, drawn over tiles by picture_colors.cpp.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "render/cpu/raster/primary_hits.h"
#include "render/picture/camera_frame.h"
#include "render/picture/view.h"
#include "render/prepare/tiles.h"

namespace render {

/// An edge of the view, projected to the picture.
struct ScreenLine {
    glm::vec2 from{0.0F};    ///< position of one end on the picture, pixels
    glm::vec2 to{0.0F};      ///< position on the picture, pixels
    float fromDepth = 1.0F;  ///< view depth at `from`, m
    float toDepth = 1.0F;    ///< view depth at `to`, m
    float width = 1.0F;      ///< width of the line, pixels
    glm::vec3 color{0.0F};
};

struct LineList {
    std::vector<ScreenLine> lines;
    CellLists tiles;  ///< indices of the lines that may touch each tile
};

/// Projects edges to the picture, without the parts that are behind the eye or outside of the picture.
LineList projectEdges(const CameraFrame& frame, std::span<const Edge> edges);

/// For each pixel of a tile, row by row: in w the share of the pixel that lines cover, and in xyz their color times
/// that share.
using LineCoverage = std::array<glm::vec4, kTilePixels>;

/// Computes how much of each pixel of a tile lines cover, where nothing nearer hides them.
/// @param samples  the primary hits of the tile
/// @param point    position in each pixel at which the coverage is measured, from the pixel's corner, pixels
LineCoverage lineCoverage(const SolidGeometry& geometry, const LineList& lines, std::size_t tile,
                          std::span<const TileRays> samples, glm::vec2 point);

}  // namespace render
