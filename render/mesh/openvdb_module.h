// What the module with OpenVDB gives to the program, which loads it when a mesh is made (isosurface.cpp).
#pragma once

#include <string>

#include "render/mesh/isosurface.h"

namespace render {

/// The functions of isosurface.h as isosurface_openvdb.cpp has them.
struct OpenVdbModule {
    const char* version;
    QuadMesh (*isosurfaceOf)(const SampledField& field);
    std::string (*encodeLevelSet)(const TriangleMesh& mesh, const LevelSetLabel& label);
};

}  // namespace render

/// Found in the module by its name.
extern "C" const render::OpenVdbModule globularOpenVdb;
