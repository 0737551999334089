// Meshes from files: OBJ, STL, PLY, glTF and what else assimp reads.
#pragma once

#include <string>

#include "scenes/shapes/mesh.h"

namespace scenes {

/// The version of assimp; empty if it is not there.
std::string assimpVersion();

/// The solid in a file, welded, in the file's coordinates. Throws InputError if the file cannot be read, is no mesh, or
/// does not enclose a volume, with the place of its first open edge.
Mesh readMesh(const std::string& path);

}  // namespace scenes
