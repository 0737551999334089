// Closed sheets of a mesh that touch each other at edges or vertices are taken apart, so that no edge has more than two
// triangles. Called when the surface of metaballs has been triangulated.
#pragma once

#include <cstdint>
#include <vector>

#include "render/mesh/triangle_mesh.h"

namespace render {

/// Gives the sheets of a closed mesh vertices of their own wherever they touch: afterwards each edge has two triangles,
/// which run along it in opposite directions, and the triangles around each vertex form one fan. Where four triangles
/// meet at an edge, the two with the inside of the surface between them stay together. New vertices are appended and
/// have the positions of old ones; triangles without an area by their indices are removed.
/// @return for each new vertex the vertex that it was split from
/// @throws std::logic_error if the mesh is not closed: the number of triangles along an edge differs by direction
std::vector<std::uint32_t> separateSheets(TriangleMesh& mesh);

}  // namespace render
