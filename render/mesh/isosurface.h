// The door to OpenVDB, which only isosurface_openvdb.cpp includes. In a build without it, and where it cannot be
// loaded, openVdbVersion() is empty, and the other functions throw.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "render/mesh/sampled_field.h"
#include "render/mesh/triangle_mesh.h"

namespace render {

/// The version of OpenVDB that is there, such as "10.0.1"; empty without it.
std::string openVdbVersion();

/// @throws SystemError if there is no OpenVDB
void requireOpenVdb();

/// Four vertices each, counterclockwise as seen from outside. The mesh is closed, but more than two quads may meet at
/// an edge.
struct QuadMesh {
    std::vector<glm::dvec3> points;  ///< in cells of the field's lattice
    std::vector<std::array<std::uint32_t, 4>> quads;
};

/// The surface where a sampled field is zero, with one vertex or more in each cell that it crosses. The result is the
/// same for any number of threads.
/// @throws SystemError if there is no OpenVDB
QuadMesh isosurfaceOf(const SampledField& field);

/// What a .vdb file says beside the values of its grid.
struct GridLabel {
    double cell = 1.0;       ///< distance of neighboring voxels, m
    glm::dvec3 origin{0.0};  ///< what the positions of the mesh or of the field's lattice are relative to, m
    double time = 0.0;       ///< of the frame, s
    int frame = 0;
    std::string sceneHash;
};

/// The bytes of a .vdb file with the level set of a closed mesh: a grid "surface" of signed distances in meters,
/// negative inside, within three voxels of the surface, with a transform in meters and the metadata "time" (double, s),
/// "frame" (int32) and "scene_hash" (string). The same mesh gives the same bytes for any number of threads.
/// @throws SystemError if there is no OpenVDB
std::string encodeLevelSet(const TriangleMesh& mesh, const GridLabel& label);

/// The bytes of a .vdb file with a metaball field: a fog volume "density" with the values of the field, in which voxels
/// are active where it is above 0. Transform and metadata are those of encodeLevelSet(), and besides them "iso_value"
/// (float), the value of the field at the surface. The same field gives the same bytes for any number of threads.
/// @param field  of sampleWhole(), on a lattice of label.cell
/// @throws SystemError if there is no OpenVDB
std::string encodeField(const SampledField& field, float isoValue, const GridLabel& label);

}  // namespace render
