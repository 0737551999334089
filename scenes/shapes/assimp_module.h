// What the module with assimp gives to the program, which loads it when it reads a mesh (mesh_file.cpp).
#pragma once

#include <string>

#include "scenes/shapes/mesh.h"

namespace scenes {

struct AssimpModule {
    /// The version of assimp's library, such as 5.2.5.
    std::string (*version)();
    /// Reads all triangles of a file into the mesh. Returns what went wrong, empty if nothing did.
    std::string (*read)(const std::string& path, Mesh& mesh);
};

}  // namespace scenes

/// Found in the module by its name.
extern "C" const scenes::AssimpModule globularAssimp;
