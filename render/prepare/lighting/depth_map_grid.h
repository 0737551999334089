// The grids of the depth maps of metaballs and of mesh obstacles on the light's plane, and the light as a camera that
// sees such a grid as its picture. The renderers fill the maps with heights, each in its own way.
#pragma once

#include <span>

#include <glm/glm.hpp>

#include "render/picture/camera_frame.h"
#include "render/picture/drawn_meshes.h"
#include "render/picture/view.h"
#include "render/prepare/lighting/light_space.h"
#include "render/prepare/skin/skin.h"

namespace render {

/// The texels of a depth map, without their heights. Texels lie at multiples of their size in the world, so that they
/// do not move when the map grows by a row or the camera moves. The map has a margin of three texels around the
/// balls or meshes, because a filter reads the neighbors of a texel.
struct DepthMapGrid {
    glm::vec2 origin{0.0F};  ///< corner of the first texel on the light's plane, relative to the eye, m
    float texelSize = 1.0F;  ///< side of a texel, m
    int columns = 0;         ///< number of texels in a row; 0 without anything that casts shadows
    int rows = 0;            ///< number of rows of texels
    float bottom = 0.0F;     ///< height below all that casts shadows, m
    float top = 0.0F;        ///< height above all that casts shadows, m

    bool empty() const { return columns == 0; }
    /// The same grid, moved by a part of a texel, for one sampling of several whose mean is the picture.
    /// @param texels  below 0.5
    DepthMapGrid shifted(glm::vec2 texels) const {
        DepthMapGrid grid = *this;
        grid.origin += texels * texelSize;
        return grid;
    }

    bool operator==(const DepthMapGrid&) const = default;
};

/// The grid that covers the kernels of a view's metaballs. It is empty if no particle has a radius above zero.
/// @param balls  one per particle of the view, as skinOf() makes them
/// @param maxTexels  number of texels along the longer side of the map
DepthMapGrid depthMapGrid(const LightBasis& basis, const View& view, std::span<const SkinBall> balls, int maxTexels);

/// The grid that covers the mesh obstacles of a view. @pre there are triangles
/// @param maxTexels  number of texels along the longer side of the map
DepthMapGrid meshDepthMapGrid(const LightBasis& basis, const View& view, const DrawnMeshes& meshes, int maxTexels);

/// The light as a camera in parallel projection. Its picture is the map, its view depth 0 is the map's top.
/// @param pixelsPerTexel  along each side of a texel
CameraFrame lightFrame(const LightBasis& basis, const DepthMapGrid& grid, glm::vec3 eye, int pixelsPerTexel);

}  // namespace render
