// OpenEXR is in a module of its own, which is looked for where the linker's run path of the program says. Linked to the
// program it would take 3 ms of every start (measured).
#include "render/output/exr.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include "render/output/openexr_module.h"
#include "render/picture/system_error.h"

namespace render {
namespace {

struct LoadedModule {
    const OpenExrModule* functions = nullptr;
    std::string failure;  ///< why there are none
};

LoadedModule load() {
#ifdef RENDER_OPENEXR_MODULE
    void* const library = dlopen(RENDER_OPENEXR_MODULE, RTLD_NOW | RTLD_LOCAL);
    const void* const functions = library == nullptr ? nullptr : dlsym(library, "globularOpenExr");
    if (functions == nullptr)
        return {nullptr, fmt::format("cannot load OpenEXR, which the format exr needs: {}", dlerror())};
    return {static_cast<const OpenExrModule*>(functions), ""};
#else
    return {nullptr, "this build has no OpenEXR, which the format exr needs; install libopenexr-dev, then build again"};
#endif
}

const LoadedModule& module() {
    static const LoadedModule loaded = load();
    return loaded;
}

}  // namespace

std::string openExrVersion() {
    return module().functions == nullptr ? "" : module().functions->version;
}

void requireOpenExr() {
    if (module().functions == nullptr) throw SystemError(module().failure);
}

std::vector<std::uint8_t> encodeExr(PictureSize size, const Layers& layers) {
    requireOpenExr();
    return module().functions->encode(size, layers);
}

}  // namespace render
