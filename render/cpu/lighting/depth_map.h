// The depth map of the metaballs as the light sees them, for their shadows. Made by the picture pass, read by
// light_visibility.cpp.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "render/picture/view.h"
#include "render/prepare/light_space.h"
#include "render/prepare/skin.h"

namespace render {

/// Heights of the surface over the light's plane, toward the light, in steps of `step` from `bottom`, counted from 1;
/// 0: no surface. Each texel has two rows of two heights, a quarter of a texel from its sides.
struct DepthMap {
    glm::vec2 origin{0.0F};  ///< corner of the first texel on the light's plane, relative to the eye, m
    float texelSize = 1.0F;  ///< m
    int columns = 1;         ///< of texels
    int rows = 1;
    float bottom = 0.0F;  ///< m
    float step = 1.0F;    ///< of the heights, m
    /// Row by row, two rows of heights per row of texels; then as many more as a vector reads from the last one on.
    std::vector<std::uint16_t> heights;
    /// Per texel: the extremes of the heights in it and in two texels around it, in steps.
    std::vector<float> lowest, highest;

    bool empty() const { return heights.empty(); }
};

struct DepthMapSampling {
    int maxTexels = 1024;   ///< along the longer side
    glm::vec2 shift{0.0F};  ///< of the texels, in texels, less than a half: pictures of several maps average them
};

/// @param balls  one per particle of the view, as skinOf() makes them
/// @return an empty map if no particle has a radius above zero
DepthMap castDepthMap(const LightBasis& basis, const View& view, std::span<const SkinBall> balls,
                      const DepthMapSampling& sampling);

}  // namespace render
