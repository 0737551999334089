// Heights of the metaballs over the light's plane, for their shadows. Called by the picture pass.
#pragma once

#include <vector>

#include <glm/glm.hpp>

#include "render/binned_field.h"
#include "render/light_space.h"

namespace render {

/// Heights of the surface over the light's plane.
struct DepthMap {
    glm::vec2 origin{0.0F};
    float texelSize = 1.0F;
    int columns = 1;
    int rows = 1;
    /// Towards the light, row by row; kNoHeight where there is no surface. One more than there are texels, so that four
    /// from any within on can be read.
    std::vector<float> heights;
};

inline constexpr float kNoHeight = -3e38F;

struct DepthMapSampling {
    int mostTexels = 1024;  ///< along the longer side
    glm::vec2 shift{0.0F};  ///< of the texels, in texels, less than a half: pictures of several maps average them
};

DepthMap castDepthMap(const LightBasis& basis, const Skinned& skin, const DepthMapSampling& sampling);

}  // namespace render
