// The depth map of the metaballs as the light sees them, for their shadows, and what it shares with that of the meshes,
// which mesh_depth_map.cpp makes. Made by cpu_renderer.cpp, read by light_visibility.cpp.
#pragma once

#include <cstdint>
#include <vector>

#include "render/prepare/lighting/depth_map_grid.h"
#include "render/prepare/metaball_scene.h"

namespace render {

/// Heights of a surface over the light's plane. A height is stored as a number of steps above `bottom`,
/// counted from 1; 0 stands for no surface. Each texel has two rows of two heights, a quarter of a texel from its
/// sides.
struct DepthMap : DepthMapGrid {
    float step = 1.0F;  ///< difference of height between two steps, m
    /// The heights, in steps from `bottom`. A row of texels has two rows of heights, of which each texel has two in
    /// each. Unused entries follow, because loads of several heights may read beyond the last one.
    std::vector<std::uint16_t> heights{};
    /// Per texel: the lowest and the highest of the stored heights within two texels of it.
    std::vector<float> lowest{}, highest{};

    /// A height in steps, not rounded.
    float stepsOf(float height) const { return (height - bottom) / step + 1.0F; }
};

/// Largest height that can be stored, in steps of the map.
inline constexpr float kMostSteps = 65535.0F;

/// A depth map with room for a grid. It has no surface yet, or what is left of an old map.
/// @param old  a map that is no longer needed, whose memory is reused
DepthMap sizedDepthMap(const DepthMapGrid& grid, DepthMap old = {});

/// Sets DepthMap::lowest and DepthMap::highest of all texels but two rows and columns at the border, which no filter
/// is centered on.
void findHeightBounds(DepthMap& map);

/// Casts the depth map of the metaballs of a view.
/// @param grid   not empty
/// @param scene  the metaballs as lightFrame() sees them, with one pixel for each texel of the grid
DepthMap castDepthMap(const DepthMapGrid& grid, const MetaballScene& scene);

}  // namespace render
