// OpenVDB is in a module of its own, which is loaded when it is first asked for: its library takes longer to load than
// all else that the program does when it starts. The module is looked for where the linker's run path of the program
// says.
#include "render/mesh/isosurface.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include "render/mesh/openvdb_module.h"
#include "render/picture/system_error.h"

namespace render {
namespace {

struct LoadedModule {
    const OpenVdbModule* functions = nullptr;
    std::string failure;  ///< why there are none
};

LoadedModule load() {
#ifdef RENDER_OPENVDB_MODULE
    void* const library = dlopen(RENDER_OPENVDB_MODULE, RTLD_NOW | RTLD_LOCAL);
    const void* const functions = library == nullptr ? nullptr : dlsym(library, "globularOpenVdb");
    if (functions == nullptr)
        return {nullptr, fmt::format("cannot load OpenVDB, which meshes and .vdb files need: {}", dlerror())};
    return {static_cast<const OpenVdbModule*>(functions), ""};
#else
    return {nullptr,
            "this build has no OpenVDB, which meshes and .vdb files need; install libopenvdb-dev and libboost-dev, "
            "then build again"};
#endif
}

const LoadedModule& module() {
    static const LoadedModule loaded = load();
    return loaded;
}

}  // namespace

std::string openVdbVersion() {
    return module().functions == nullptr ? "" : module().functions->version;
}

void requireOpenVdb() {
    if (module().functions == nullptr) throw SystemError(module().failure);
}

QuadMesh isosurfaceOf(const SampledField& field) {
    requireOpenVdb();
    return module().functions->isosurfaceOf(field);
}

std::string encodeLevelSet(const TriangleMesh& mesh, const GridLabel& label) {
    requireOpenVdb();
    return module().functions->encodeLevelSet(mesh, label);
}

std::string encodeField(const SampledField& field, float isoValue, const GridLabel& label) {
    requireOpenVdb();
    return module().functions->encodeField(field, isoValue, label);
}

}  // namespace render
