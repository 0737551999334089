// The edges of a view as straight lines on the picture: projected, clipped and binned to tiles. Made by the picture
// pass, read by line_coverage.cpp.
#pragma once

#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "render/picture/camera_frame.h"
#include "render/picture/view.h"
#include "render/prepare/tiles.h"

namespace render {

/// A projected edge.
struct ScreenLine {
    glm::vec2 from{0.0F};  ///< position on the picture, pixels
    glm::vec2 to{0.0F};
    float fromDepth = 1.0F;  ///< view depth, m
    float toDepth = 1.0F;
    float width = 1.0F;  ///< pixels
    glm::vec3 color{0.0F};
};

struct LineList {
    std::vector<ScreenLine> lines;
    CellLists tiles;  ///< lines that may touch each tile
};

/// Leaves out the parts of edges that are behind the eye or outside of the picture.
LineList projectEdges(const CameraFrame& frame, std::span<const Edge> edges);

}  // namespace render
