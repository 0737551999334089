// Edges of boxes and the like as straight lines on the picture: projected, clipped, binned to tiles. Used by the
// picture pass.
#pragma once

#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "render/picture/camera_frame.h"
#include "render/picture/view.h"
#include "render/prepare/tiles.h"

namespace render {

/// A line as it is seen.
struct ScreenLine {
    glm::vec2 from{0.0F};  ///< pixels
    glm::vec2 to{0.0F};
    float fromDepth = 1.0F;  ///< in view, m
    float toDepth = 1.0F;
    float width = 1.0F;  ///< pixels
    glm::vec3 color{0.0F};
};

struct LineList {
    std::vector<ScreenLine> lines;
    CellLists tiles;
};

/// Leaves out what is behind the eye or outside the picture.
LineList projectEdges(const CameraFrame& frame, std::span<const Edge> edges);

}  // namespace render
