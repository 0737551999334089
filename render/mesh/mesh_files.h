// Meshes as files that other programs read. The functions here return bytes; the program writes the files.
#pragma once

#include <string>
#include <vector>

#include "render/mesh/triangle_mesh.h"

namespace render {

/// What a file says beside the mesh.
struct MeshLabel {
    glm::dvec3 origin{0.0};             ///< what the positions of the mesh are relative to, m
    std::vector<std::string> comments;  ///< lines of text
};

/// The bytes of a binary little-endian PLY file: float x y z (m), float nx ny nz, uchar red green blue (sRGB),
/// float vx vy vz (m/s), and faces as lists of three uint indices, vertex_indices.
std::string encodePly(const TriangleMesh& mesh, const MeshLabel& label);

/// The text of an OBJ file: "v x y z r g b" with colors in sRGB from 0 to 1, which Blender, MeshLab and others read,
/// "vn" and "f". It has no place for velocities.
std::string encodeObj(const TriangleMesh& mesh, const MeshLabel& label);

}  // namespace render
