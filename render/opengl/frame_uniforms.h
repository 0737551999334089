// The uniform block Frame of shaders/frame_block.glsl, which says what each number means.
#pragma once

#include <glm/glm.hpp>

#include "render/prepare/prepared_view.h"

namespace render {

/// The block in the layout std140: vectors of four numbers alone, which C++ and GLSL lay out alike.
struct FrameUniforms {
    glm::vec4 image, right, up, forward;
    glm::vec4 toLight, lightU, lightV, lightColor;
    glm::vec4 sky, skyBelow;
    glm::vec4 surface, body;
    glm::vec4 surroundingsTop, surroundingsHorizon, surroundingsBottom;
    glm::vec4 backgroundTop, backgroundBottom;
    glm::vec4 groundColor, groundCenter;
    glm::vec4 lightCells, boxCells, skyCells, glowCells, depthMapGrid, depthMapSize;
    glm::vec4 sampleOffset;
    glm::vec4 lightCellCount, skyCellCount, glowCellCount, metaballs, counts;
};

/// @param offset  of a single sample from the pixel's middle, pixels; the depth map is moved by as much of its texels
FrameUniforms frameUniforms(const PreparedView& view, glm::vec2 offset);

}  // namespace render
