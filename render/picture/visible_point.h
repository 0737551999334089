// What the renderer tells of a pixel beside its color. Made by picture_colors.cpp, read by the studies.
#pragma once

#include <glm/glm.hpp>

namespace render {

/// What the ray through a pixel's middle meets first; of metaballs, in draft and normal quality, what its neighbors
/// tell.
struct VisiblePoint {
    glm::vec3 normal{0.0F};  ///< unit length, world axes
    float depth = -1.0F;     ///< view depth, m; -1: nothing is met
};

}  // namespace render
