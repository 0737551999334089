// What the module with OpenVDB gives to the program, which loads it when it needs distances from a mesh
// (mesh_distances.cpp).
#pragma once

#include "engine/shapes/distance_grid.h"
#include "scenes/shapes/mesh_distances.h"

namespace scenes {

struct DistancesModule {
    /// The bricks of mesh_distances.h.
    engine::DistanceBricks (*bricksOf)(const Mesh& mesh, const VoxelGrid& grid);
};

}  // namespace scenes

/// Found in the module by its name.
extern "C" const scenes::DistancesModule globularDistances;
