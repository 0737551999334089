// What the module with OpenVDB gives to the program, which loads it when it makes meshes and .vdb files
// (isosurface.cpp).
#pragma once

#include <string>

#include "render/mesh/isosurface.h"

namespace render {

/// The functions of isosurface.h as isosurface_openvdb.cpp has them.
struct OpenVdbModule {
    const char* version;
    QuadMesh (*isosurfaceOf)(const SampledField& field);
    std::string (*encodeLevelSet)(const TriangleMesh& mesh, const GridLabel& label);
    std::string (*encodeField)(const SampledField& field, float isoValue, const GridLabel& label);
};

}  // namespace render

/// Found in the module by its name.
extern "C" const render::OpenVdbModule globularOpenVdb;
