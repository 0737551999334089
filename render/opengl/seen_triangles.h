// The triangles of mesh obstacles that a picture may show, and the tiles that they may touch. Made by mesh_passes.cpp
// for each picture.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "render/prepare/prepared_view.h"

namespace render {

/// The corners of a triangle as indices of DrawnMeshes::positions.
using TriangleCorners = std::array<std::uint32_t, 3>;

struct SeenTriangles {
    std::vector<TriangleCorners> triangles;
    std::vector<char> tiles;  ///< per tile: whether a triangle may touch it
    float nearest = 0.0F;     ///< view depth before which nothing is seen in perspective, m
    float farthest = 0.0F;    ///< a view depth beyond all triangles, m
};

/// Lists the triangles before the eye that lie within the picture. Those that are turned away from the eye are left out
/// where the eye is outside of the box around their mesh: it cannot be inside of the solid, whose front hides them.
SeenTriangles seenTriangles(const PreparedView& view);

/// The triangles that are turned away from the light.
std::vector<TriangleCorners> unlitTriangles(const PreparedView& view);

}  // namespace render
