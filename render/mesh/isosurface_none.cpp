// Stands in for isosurface_openvdb.cpp where the build has no OpenVDB.
#include "render/mesh/isosurface.h"
#include "render/picture/system_error.h"

namespace render {
namespace {

[[noreturn]] void fail() {
    throw SystemError(kNoOpenVdb);
}

}  // namespace

std::string openVdbVersion() {
    return {};
}

QuadMesh isosurfaceOf(const SampledField&) {
    fail();
}

std::string encodeLevelSet(const TriangleMesh&, const LevelSetLabel&) {
    fail();
}

}  // namespace render
