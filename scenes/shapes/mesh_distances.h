// Signed distances from meshes, on sparse grids of voxels.
#pragma once

#include <string>

#include "engine/shapes/distance_grid.h"
#include "scenes/shapes/mesh.h"

namespace scenes {

/// Width of the band of distances outside of a mesh, in voxels.
inline constexpr float kBandVoxels = 3.0F;

/// Number of voxels of a grid of distances, estimated of the mesh's volume and area.
double estimatedVoxels(const Mesh& mesh, double voxel);

/// The signed distances from a closed mesh, whose inside is filled with them: the same bits for any number of threads.
/// @param mesh  without problems (mesh.h), m
/// @param voxel  edge of a voxel, m
/// Throws InputError, which names the path, in a build without OpenVDB, if a wall is thinner than two voxels, with its
/// place, and if the grid would have more than 5e8 voxels.
engine::DistanceGrid distancesOf(const Mesh& mesh, double voxel, const std::string& path);

}  // namespace scenes
