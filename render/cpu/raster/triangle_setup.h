// The functions by which rays through a tile are tested against triangles. Made for mesh_hits.cpp.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include <glm/glm.hpp>

#include "render/cpu/raster/primary_hits.h"

namespace render {

/// Up to 16 triangles as seen from a tile, as a structure of arrays. A function is linear on the picture: x and y are
/// multiplied by a point's distances from the tile's corner, in pixels, and z is added.
struct TriangleGroup {
    static constexpr std::size_t kMost = 16;
    using Values = std::array<float, kMost>;

    struct Functions {
        Values x, y, z;

        glm::vec3 operator[](std::size_t triangle) const { return {x[triangle], y[triangle], z[triangle]}; }
    };

    std::array<Functions, 3> edges;  ///< edge functions, which are positive inside
    Functions depth;                 ///< 1 / view depth in perspective, view depth in parallel projection
    Values front, back;              ///< least and greatest view depth, m
};

/// The functions of triangles.
/// @param indices  of the triangles in DrawnMeshes, at most TriangleGroup::kMost
/// @param corner   top left corner of the tile, pixels
TriangleGroup triangleGroup(const SolidGeometry& geometry, std::span<const std::uint32_t> indices, glm::vec2 corner);

}  // namespace render
