// Signed distances from meshes, on sparse grids of voxels.
#pragma once

#include <string>

#include "engine/shapes/distance_grid.h"
#include "scenes/shapes/mesh.h"

namespace scenes {

/// How finely distances from a mesh are sampled, and how far outside of it.
struct VoxelGrid {
    double voxel = 1.0;  ///< edge of a voxel, m
    double band = 3.0;   ///< distance up to which distances are known outside, at least three voxels, m
};

/// Number of voxels of a grid of distances, estimated of the mesh's volume and area.
double estimatedVoxels(const Mesh& mesh, const VoxelGrid& grid);

/// The signed distances from a closed mesh, whose inside is filled with them: the same bits for any number of threads.
/// @param mesh  without problems (mesh.h), m
/// Throws InputError, which names the path, in a build without OpenVDB, if a wall is thinner than two voxels, with its
/// place, and if the grid would have more than 5e8 voxels.
engine::DistanceGrid distancesOf(const Mesh& mesh, const VoxelGrid& grid, const std::string& path);

}  // namespace scenes
