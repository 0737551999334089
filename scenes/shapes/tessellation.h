// The surfaces of solids as triangles, and their edges as lines, for pictures. Chords are off the surface by less than
// a thousandth of its size.
#pragma once

#include <utility>
#include <vector>

#include "render/picture/view.h"
#include "scenes/shapes/mesh.h"
#include "scenes/shapes/profile.h"

namespace scenes {

/// The surface of a solid of revolution around the y axis. Edges of a solid's profile that meet at more than 30 degrees
/// stay sharp; walls are round at their ends.
/// @param profile  refined, as engine::Revolution takes it
render::SolidMesh revolutionMesh(const Profile& profile, bool isClosed, double halfThickness);

/// The surface of a ball around the origin. @param radius  m
render::SolidMesh ballMesh(double radius);

/// The surface of a box around the origin.
/// @param size  edge lengths, m
render::SolidMesh cuboidMesh(const engine::Vec3& size);

/// A closed mesh with normals that are smooth over edges at which its triangles meet at less than 40 degrees.
render::SolidMesh smoothMesh(const Mesh& mesh);

using Line = std::pair<engine::Vec3, engine::Vec3>;

/// A box's twelve edges, each once.
std::vector<Line> edgesOfBox(const engine::Vec3& minimum, const engine::Vec3& maximum);

/// The edges of a mesh at which triangles meet at more than 30 degrees.
/// @param origin  of the mesh's coordinates, m
std::vector<Line> sharpEdges(const render::SolidMesh& mesh, const engine::Vec3& origin);

/// Circles through the ends and the corners of a profile that is turned around the y axis, and four curves along it.
/// @param origin  of the profile, m
std::vector<Line> outlinesOf(const ProfileSpec& spec, const engine::Vec3& origin);

}  // namespace scenes
