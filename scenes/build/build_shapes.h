// Solids from the keys of [[body]] and [[obstacle]] tables: profiles that are turned, meshes, letters and images.
#pragma once

#include "scenes/build/builders.h"
#include "scenes/shapes/mesh_distances.h"
#include "scenes/shapes/profile.h"
#include "scenes/shapes/solid.h"

namespace scenes {

/// Whether a table's shape is a profile that is turned around an axis: cylinder, cone, frustum, capsule or revolution.
bool isTurned(const Section& section);

/// Whether the particles of a body are those inside of a Solid: all shapes but grid, points and file, and boxes and
/// balls only where they are turned or hollow.
bool isFilledSolid(const Section& section);

/// Checks the keys of the tables' shapes against one another, and reads their meshes into the context. Records what is
/// wrong, with keys that are missing and with files.
void readShapes(std::vector<Section>& sections, BuildContext& context);

/// The profile of a table that isTurned() and has no problems.
ProfileSpec profileFrom(const Section& section);

/// The mesh of a table without problems, in the coordinates of its file; readShapes() has read it.
const Mesh& meshFrom(const Section& section, const BuildContext& context);

/// That mesh scaled, around the middle of its bounds: in the coordinates that placementFrom() places.
Mesh placedMeshFrom(const Section& section, const BuildContext& context);

/// The distances from that mesh, of which the context notes how many voxels they have. Throws InputError as
/// mesh_distances.h says.
engine::DistanceGrid gridFrom(const Section& section, const VoxelGrid& grid, BuildContext& context);

/// Where the table places its shape. The rotation is about the center.
Placement placementFrom(const Section& section, const BuildContext& context);

/// How far the solid of a body that isFilledSolid() and has no problems reaches along a unit vector, m.
double reachOf(const Section& section, const engine::Vec3& direction, const BuildContext& context);

/// The solid of a body.
/// @param voxel  of the distances from a mesh, m
/// Throws InputError if a mesh has no distances at this voxel (mesh_distances.h).
Solid solidFrom(const Section& section, double voxel, BuildContext& context);

}  // namespace scenes
