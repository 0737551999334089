// What both backends share: creating the context, loading the functions, and refusing renderers that may not give the
// same pixels on every machine.
#include "render/opengl/context.h"

#include <fmt/format.h>

#include "render/picture/system_error.h"

namespace render {

namespace {

std::string stringOf(const Gl& gl, GLenum name) {
    const GLubyte* text = gl.GetString(name);
    return text == nullptr ? std::string("unknown") : std::string(reinterpret_cast<const char*>(text));
}

/// The driver of a GPU may change the bits of pixels that it stores. Besides, the studies compare drawing times on the
/// CPU.
void requireSoftware(const std::string& rendererName) {
    for (const char* known : {"llvmpipe", "softpipe"}) {
        if (rendererName.find(known) != std::string::npos) return;
    }
    throw SystemError(fmt::format(
        "OpenGL is drawn by '{}', not by Mesa's software renderer; set LIBGL_ALWAYS_SOFTWARE=1", rendererName));
}

}  // namespace

std::optional<Backend> backendNamed(std::string_view name) {
    if (name == "osmesa") return Backend::osmesa;
    if (name == "egl") return Backend::egl;
    return std::nullopt;
}

Context::Context(Backend backend) : native_(backend == Backend::osmesa ? makeOsmesaContext() : makeEglContext()) {
    const CurrentContext current(*this);
    gl_ = loadGl([this](const char* name) { return native_->address(name); });
    GLint major = 0;
    GLint minor = 0;
    gl_.GetIntegerv(GL_MAJOR_VERSION, &major);
    gl_.GetIntegerv(GL_MINOR_VERSION, &minor);
    rendererName_ = stringOf(gl_, GL_RENDERER);
    if (major * 10 + minor < 33) {
        throw SystemError(fmt::format("OpenGL 3.3 is needed, '{}' offers {}.{}", rendererName_, major, minor));
    }
    requireSoftware(rendererName_);
}

CurrentContext::~CurrentContext() {
    try {
        context_.release();
    } catch (const SystemError&) {
        // A destructor must not throw. The context stays bound, and the next makeCurrent() reports the error.
    }
}

}  // namespace render
