// The surfaces of solids as triangles, for pictures. Chords are off the surface by less than a thousandth of its size.
#pragma once

#include "render/picture/view.h"
#include "scenes/shapes/mesh.h"
#include "scenes/shapes/profile.h"

namespace scenes {

/// The surface of a solid of revolution around the y axis. Edges of a solid's profile that meet at more than 30 degrees
/// stay sharp; walls are round at their ends.
/// @param profile  refined, as engine::Revolution takes it
render::SolidMesh revolutionMesh(const Profile& profile, bool isClosed, double halfThickness);

/// The surface of a box around the origin.
/// @param size  edge lengths, m
render::SolidMesh cuboidMesh(const engine::Vec3& size);

/// A closed mesh with normals that are smooth over edges at which its triangles meet at less than 40 degrees.
render::SolidMesh smoothMesh(const Mesh& mesh);

}  // namespace scenes
