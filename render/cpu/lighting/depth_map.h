// Heights of the metaballs over the light's plane, for their shadows. Called by the picture pass.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "render/cpu/metaballs/binned_field.h"
#include "render/prepare/light_space.h"

namespace render {

/// Heights of the surface over the light's plane, toward the light, in steps from where it ends; 0: no surface. A
/// texel has two rows of two, the first of them a quarter of a texel from its sides.
struct DepthMap {
    glm::vec2 origin{0.0F};
    float texelSize = 1.0F;
    int columns = 1;
    int rows = 1;
    float bottom = 0.0F;
    float step = 1.0F;  ///< m
    /// Row by row, two rows a row of texels; as many more as are read from the last one on.
    std::vector<std::uint16_t> heights;
    /// Per texel, in steps: of all heights in it and in two texels around it.
    std::vector<float> lowest, highest;

    bool empty() const { return heights.empty(); }
};

struct DepthMapSampling {
    int mostTexels = 1024;  ///< along the longer side
    glm::vec2 shift{0.0F};  ///< of the texels, in texels, less than a half: pictures of several maps average them
};

DepthMap castDepthMap(const LightBasis& basis, const Skinned& skin, const DepthMapSampling& sampling);

}  // namespace render
