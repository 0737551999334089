// OpenVDB is in a module of its own, which is loaded when it is first asked for, as in render/mesh/isosurface.cpp.
#include "scenes/shapes/mesh_distances.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <cmath>

#include "scenes/shapes/distances_module.h"
#include "scenes/text/input_error.h"

namespace scenes {
namespace {

/// Chosen: their values take 3 GB.
constexpr double kMostVoxels = 5e8;

const DistancesModule& distancesModule(const std::string& path) {
#ifdef SCENES_DISTANCES_MODULE
    static void* const library = dlopen(SCENES_DISTANCES_MODULE, RTLD_NOW | RTLD_LOCAL);
    static const void* const functions = library == nullptr ? nullptr : dlsym(library, "globularDistances");
    if (functions == nullptr)
        throw InputError(path, fmt::format("cannot load OpenVDB, which finds distances from meshes: {}", dlerror()));
    return *static_cast<const DistancesModule*>(functions);
#else
    throw InputError(path,
                     "this build has no OpenVDB, which finds distances from meshes; install libopenvdb-dev and "
                     "libboost-dev, then build again");
#endif
}

}  // namespace

double estimatedVoxels(const Mesh& mesh, const VoxelGrid& grid) {
    const double voxel = grid.voxel;
    double area = 0.0;
    for (const auto& [a, b, c] : mesh.triangles)
        area +=
            0.5 *
            std::sqrt(engine::squaredLength((mesh.points[b] - mesh.points[a]).cross(mesh.points[c] - mesh.points[a])));
    // Bricks reach further than the band, by half their edge on average.
    return std::abs(massOf(mesh).volume) / (voxel * voxel * voxel) +
           area * (grid.band / voxel + 0.5 * engine::kBrickVoxels) / (voxel * voxel);
}

engine::DistanceGrid distancesOf(const Mesh& mesh, const VoxelGrid& grid, const std::string& path) {
    const double voxel = grid.voxel;
    const double voxels = estimatedVoxels(mesh, grid);
    if (!(voxels <= kMostVoxels))
        throw InputError(path, fmt::format("the mesh would have about {:.2g} voxels of {:.3g} m, at most {:.0e} are "
                                           "allowed; use larger particles, or scale it down",
                                           voxels, voxel, kMostVoxels));
    if (const ThinPlace thin = thinnestPlace(mesh, 2.0 * voxel); thin.isFound)
        throw InputError(path,
                         fmt::format("the mesh is {:.3g} m thin near ({:.6g}, {:.6g}, {:.6g}) of its own "
                                     "coordinates after scaling, from the middle of its bounds; particles of "
                                     "this size need at least {:.3g} m: thicken it, scale it up, or use smaller "
                                     "particles",
                                     thin.thickness, thin.place.x(), thin.place.y(), thin.place.z(), 2.0 * voxel));
    return engine::DistanceGrid(distancesModule(path).bricksOf(mesh, grid));
}

}  // namespace scenes
