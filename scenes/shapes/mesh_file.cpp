// assimp is in a module of its own, which is loaded when it is first asked for. The module is looked for where the
// linker's run path of the program says.
#include "scenes/shapes/mesh_file.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <algorithm>

#include "scenes/shapes/assimp_module.h"
#include "scenes/text/input_error.h"
#include "scenes/text/read_file.h"

namespace scenes {
namespace {

struct LoadedModule {
    const AssimpModule* functions = nullptr;
    std::string failure;  ///< why there are none
};

LoadedModule load() {
#ifdef SCENES_ASSIMP_MODULE
    void* const library = dlopen(SCENES_ASSIMP_MODULE, RTLD_NOW | RTLD_LOCAL);
    const void* const functions = library == nullptr ? nullptr : dlsym(library, "globularAssimp");
    if (functions == nullptr) return {nullptr, fmt::format("cannot load assimp, which reads meshes: {}", dlerror())};
    return {static_cast<const AssimpModule*>(functions), ""};
#else
    return {nullptr, "this build has no assimp, which reads meshes; install libassimp-dev, then build again"};
#endif
}

const LoadedModule& module() {
    static const LoadedModule loaded = load();
    return loaded;
}

/// A message of assimp in one line.
std::string inOneLine(std::string text) {
    std::ranges::replace(text, '\n', ' ');
    while (!text.empty() && (text.back() == ' ' || text.back() == '.')) text.pop_back();
    return text;
}

}  // namespace

std::string assimpVersion() {
    return module().functions == nullptr ? "" : module().functions->version();
}

Mesh readMesh(const std::string& path) {
    readFile(path, kMaxParticleFileBytes);  // says in the program's own words what is wrong with the path
    Mesh mesh;
    if (module().functions == nullptr) throw InputError(path, module().failure);
    const std::string problem = module().functions->read(path, mesh);
    if (!problem.empty())
        throw InputError(path, fmt::format("not a mesh in a format that is read, such as OBJ, STL, PLY or glTF: {}",
                                           inOneLine(problem)));
    Mesh solid = welded(mesh);
    if (const std::string flaw = meshProblem(solid); !flaw.empty()) throw InputError(path, "the mesh " + flaw);
    return solid;
}

}  // namespace scenes
