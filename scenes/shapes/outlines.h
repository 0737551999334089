// Lines that show a shape without its surface: its edges, and curves along it.
#pragma once

#include <utility>
#include <vector>

#include "render/picture/view.h"
#include "scenes/shapes/profile.h"

namespace scenes {

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
