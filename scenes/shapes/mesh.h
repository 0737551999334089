// Triangle meshes that users bring: whether they enclose a volume, and which.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "engine/core/bounding_box.h"

namespace scenes {

struct Mesh {
    std::vector<engine::Vec3> points;                     ///< m
    std::vector<std::array<std::uint32_t, 3>> triangles;  ///< of points
};

/// The mesh with one point where several are equal, without triangles that have the same point twice, and without
/// points of no triangle.
Mesh welded(const Mesh& mesh);

/// The volume that a closed mesh encloses (m^3), negative if its triangles run clockwise as seen from outside, and the
/// center of mass of that volume (m): both by the divergence theorem.
struct MassProperties {
    double volume = 0.0;
    engine::Vec3 center = engine::Vec3::Zero();
};
MassProperties massOf(const Mesh& mesh);

engine::BoundingBox boundsOf(const Mesh& mesh);

/// What keeps a welded mesh from being a solid, as a sentence without its beginning, such as "is open: ..."; empty if
/// nothing does. Names the first open edge by its ends, in the mesh's coordinates.
std::string meshProblem(const Mesh& mesh);

/// Where the solid that a closed mesh encloses is thinner than given, as a point of a triangle and the distance of its
/// opposite; nothing if it is so nowhere. Wedges of less than 25 degrees count as thin at their edge.
struct ThinPlace {
    bool isFound = false;
    engine::Vec3 place = engine::Vec3::Zero();  ///< m
    double thickness = 0.0;                     ///< m
};
ThinPlace thinnestPlace(const Mesh& mesh, double thickness);

/// The mesh scaled, moved so that the middle of its bounds is the origin, and with triangles that run counterclockwise
/// as seen from outside.
Mesh centeredMesh(const Mesh& mesh, double scale);

}  // namespace scenes
