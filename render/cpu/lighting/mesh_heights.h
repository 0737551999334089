// Drawing of triangles into the heights of a depth map. Called by mesh_depth_map.cpp.
#pragma once

#include <cstdint>
#include <span>

#include <glm/glm.hpp>

#include "render/picture/drawn_meshes.h"

namespace render {

/// Triangles on a depth map.
struct HeightTriangles {
    std::span<const glm::vec3> corners;  ///< x and y count the columns and rows of heights, z is a height in steps
    std::span<const DrawnTriangle> triangles;
};

/// Some of the rows of heights of a depth map.
struct HeightRows {
    std::uint16_t* heights = nullptr;  ///< of the first of these rows; the others follow
    int columns = 0;                   ///< at least 8
    int first = 0;                     ///< numbers of the first and the last row
    int last = -1;
};

/// Draws some of the triangles into rows of heights, of which each keeps the greatest. The result is the same, bit for
/// bit, with any instruction set.
/// @param indices  of the triangles, none of which the light sees from its edge
void drawHeights(const HeightTriangles& triangles, std::span<const std::uint32_t> indices, const HeightRows& rows);

}  // namespace render
