// The surface of metaballs as a closed mesh of triangles, with normals, colors and velocities. Called by `globular
// mesh` for each frame. The field is that of the renderers (render/prepare/skin/skin.h).
#pragma once

#include <span>

#include <glm/glm.hpp>

#include "render/mesh/triangle_mesh.h"
#include "render/picture/view.h"

namespace render {

/// The surface of a view's metaballs, whatever its style is.
///
/// Vertices lie on the surface, but for rounding; triangles stretch between them. No edge is open, and each has two
/// triangles; all face outward. Normals are those of the field, colors and velocities the means of the particles'
/// weighted by their kernels. Parts of the surface that fall between the nodes of the lattice are missed: lone balls of
/// less than about half a cell, and gaps as narrow. The mesh is empty if the view has no particle with a radius above
/// 0. The same arguments give the same bits for any number of threads.
/// @param velocities  of the view's particles, m/s
/// @param cell        distance of neighboring nodes of the lattice that the field is sampled at, m, > 0: the triangles'
///                    sides are about as long
/// @throws SystemError in a build without OpenVDB
TriangleMesh surfaceMesh(const View& view, std::span<const glm::vec3> velocities, double cell);

}  // namespace render
