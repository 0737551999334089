// The functions by which rays through a tile are tested against a triangle. Made for mesh_hits.cpp.
#pragma once

#include <array>
#include <cstdint>

#include <glm/glm.hpp>

#include "render/cpu/raster/primary_hits.h"

namespace render {

/// A triangle as seen from a tile. A vector stands for a linear function of a point of the picture: x and y are
/// multiplied by the point's distances from the tile's corner, in pixels, and z is added.
struct TriangleSetup {
    std::array<glm::vec3, 3> edges;  ///< edge functions, which are positive inside
    glm::vec3 depth;                 ///< 1 / view depth in perspective, view depth in parallel projection
    float front = 0.0F;
    float back = 0.0F;
};

/// The functions of a triangle.
/// @param index   of the triangle in DrawnMeshes
/// @param corner  top left corner of the tile, pixels
TriangleSetup triangleSetup(const SolidGeometry& geometry, std::uint32_t index, glm::vec2 corner);

}  // namespace render
