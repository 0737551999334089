// How much of the light transparent metaballs let through, as a map over the light's plane: section 4 of
// shading_model.h defines it. Made by the preparation of a view whose metaballs are transparent and cast shadows.
#pragma once

#include <vector>

#include <glm/glm.hpp>

#include "render/picture/view.h"
#include "render/prepare/lighting/light_space.h"

namespace render {

/// Optical depths of columns along the light, for red, green and blue: the negative binary logarithms of the light's
/// share that is left behind all metaballs. They are interpolated linearly between texels.
struct OpticalDepthMap {
    glm::vec2 origin{0.0F};  ///< middle of the first texel on the light's plane, relative to the eye, m
    float texelSize = 1.0F;  ///< m
    int columns = 0;         ///< number of texels in a row; 0 for an empty map
    int rows = 0;
    std::vector<float> depths;  ///< row by row, three for each texel; those at the border are 0

    bool empty() const { return columns == 0; }
};

/// The map of a view's particles.
/// @param eye  world coordinates, m
OpticalDepthMap opticalDepthMap(const LightBasis& basis, const View& view, glm::vec3 eye);

}  // namespace render
