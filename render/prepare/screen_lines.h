// The edges of a view as lines on the picture, clipped to what the camera sees and listed for the tiles that they
// touch. Made for both renderers, which find out what hides them.
#pragma once

#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "render/picture/camera_frame.h"
#include "render/picture/view.h"
#include "render/prepare/cells/tiles.h"

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

/// The parameter t of the point from + t (to - from) of a line that is closest to a pixel.
float closestParameter(const ScreenLine& line, glm::vec2 pixel);

}  // namespace render
