// The depth map of the mesh obstacles as the light sees them, for their shadows. Made by cpu_renderer.cpp once for each
// picture, read by light_visibility.cpp.
#pragma once

#include "render/cpu/lighting/depth_map.h"
#include "render/picture/drawn_meshes.h"
#include "render/prepare/lighting/light_space.h"

namespace render {

/// Draws the depth map of meshes. It has the heights of the surfaces that are turned away from the light, at which rays
/// to the light enter a solid from below. For a point outside of all solids they decide as the upper surfaces do,
/// and the surfaces that light reaches lie above them by the thickness of the solid: no surface shades itself.
/// @param grid  not empty
/// @param old   a map that is no longer needed, whose memory is reused
DepthMap meshDepthMap(const LightBasis& basis, const DepthMapGrid& grid, const DrawnMeshes& meshes, DepthMap old);

}  // namespace render
