// What meshes of metaballs cost and how exact they are: time, size, and distance from the oracle's surface against the
// length of the cell. Called by `globular study meshes`, which writes the results.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "render/picture/view.h"

namespace studies {

struct MeshStudySettings {
    std::size_t particles = 6000;                        ///< in the dam break that is meshed
    std::vector<double> cells = {1.0, 0.5, 0.33, 0.25};  ///< lengths of the cell, in particle radii
    int rounds = 5;               ///< how many times each mesh is made, for the median of the times
    std::size_t samples = 20000;  ///< at most how many vertices, and triangles, are measured
};

/// Distances of points from a surface, particle radii.
struct SurfaceDistance {
    double mean = 0.0;
    double worst = 0.0;
};

struct MeshRow {
    render::Skin skin = render::Skin::plain;
    double cell = 0.0;  ///< particle radii
    std::size_t vertices = 0;
    std::size_t triangles = 0;
    double seconds = 0.0;        ///< median time to make the mesh, s
    double megabytes = 0.0;      ///< size of the PLY file, 10^6 bytes
    SurfaceDistance atVertices;  ///< of the vertices
    SurfaceDistance atCenters;   ///< of the triangles' centers
    double pool = 0.0;  ///< volume of the mesh of the level pool (level_pool.h), in lattice cells of its particles
};

/// Measures the dam break of the study of pictures and the level pool, for both skins and each cell. The distances are
/// along the normals, by rays of the oracle.
/// @param listener  called with all rows so far whenever there is one more
/// @throws render::SystemError in a build without OpenVDB
std::vector<MeshRow> measureMeshes(const MeshStudySettings& settings,
                                   const std::function<void(const std::vector<MeshRow>&)>& listener);

/// The rows as a CSV table.
std::string meshesCsv(const std::vector<MeshRow>& rows);

}  // namespace studies
