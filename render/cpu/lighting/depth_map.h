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

/// Heights of the metaballs' surface over the light's plane. A height is stored as a number of steps above `bottom`,
/// counted from 1; 0 stands for no surface. Each texel has two rows of two heights, a quarter of a texel from its
/// sides.
struct DepthMap {
    glm::vec2 origin{0.0F};  ///< corner of the first texel on the light's plane, relative to the eye, m
    float texelSize = 1.0F;  ///< side of a texel, m
    int columns = 1;         ///< number of texels in a row
    int rows = 1;            ///< number of rows of texels
    float bottom = 0.0F;     ///< height that the steps are counted from, m
    float step = 1.0F;       ///< difference of height between two steps, m
    /// The heights, in steps from `bottom`. A row of texels has two rows of heights, of which each texel has two in
    /// each. Unused entries follow, because loads of several heights may read beyond the last one.
    std::vector<std::uint16_t> heights;
    /// Per texel: the lowest and the highest of the stored heights within two texels of it.
    std::vector<float> lowest, highest;

    bool empty() const { return heights.empty(); }
};

struct DepthMapSampling {
    int maxTexels = 1024;   ///< number of texels along the longer side of the map
    glm::vec2 shift{0.0F};  ///< shift of the grid of texels for one sampling of several, in texels, below 0.5
};

/// Casts the depth map of the metaballs of a view.
/// @param balls  one per particle of the view, as skinOf() makes them
/// @return an empty map if no particle has a radius above zero
DepthMap castDepthMap(const LightBasis& basis, const View& view, std::span<const SkinBall> balls,
                      const DepthMapSampling& sampling);

}  // namespace render
