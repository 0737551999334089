// EGL without a surface: the backend for systems whose Mesa no longer includes OSMesa.
#include "render/opengl/context.h"
#include "render/picture/system_error.h"

#ifdef RENDER_HAS_EGL

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <fmt/format.h>

#include <array>

namespace render {

namespace {

[[noreturn]] void fail(const char* tried) {
    throw SystemError(fmt::format("EGL without a display: {} failed with error 0x{:04x}", tried, eglGetError()));
}

class EglContext final : public NativeContext {
 public:
    EglContext() {
        display_ = eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, nullptr, nullptr);
        if (display_ == EGL_NO_DISPLAY) fail("eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA)");
        // The display belongs to the process and is not reference-counted: it is never terminated, because another
        // context may still use it.
        if (eglInitialize(display_, nullptr, nullptr) == EGL_FALSE) fail("eglInitialize");
        if (eglBindAPI(EGL_OPENGL_API) == EGL_FALSE) fail("eglBindAPI(EGL_OPENGL_API)");
        const std::array<EGLint, 7> attributes = {
            EGL_CONTEXT_MAJOR_VERSION,           3,       EGL_CONTEXT_MINOR_VERSION, 3, EGL_CONTEXT_OPENGL_PROFILE_MASK,
            EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};
        context_ = eglCreateContext(display_, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes.data());
        if (context_ == EGL_NO_CONTEXT) fail("eglCreateContext for OpenGL 3.3 core");
    }
    ~EglContext() override { eglDestroyContext(display_, context_); }
    EglContext(const EglContext&) = delete;
    EglContext& operator=(const EglContext&) = delete;

    void makeCurrent() override {
        bindApi();
        if (eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_) == EGL_FALSE) fail("eglMakeCurrent");
    }
    void release() override {
        bindApi();
        if (eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT) == EGL_FALSE) {
            fail("eglMakeCurrent to no context");
        }
        // EGL frees its data for a thread when the thread ends, and again when the process ends. Freeing the data here
        // keeps a worker thread that ends late from freeing it twice.
        if (eglReleaseThread() == EGL_FALSE) fail("eglReleaseThread");
    }
    GlFunction address(const char* name) override { return eglGetProcAddress(name); }

 private:
    // The bound API is a property of the thread, and frames are drawn by several threads.
    static void bindApi() {
        if (eglBindAPI(EGL_OPENGL_API) == EGL_FALSE) fail("eglBindAPI(EGL_OPENGL_API)");
    }

    EGLDisplay display_ = EGL_NO_DISPLAY;
    EGLContext context_ = EGL_NO_CONTEXT;
};

}  // namespace

std::unique_ptr<NativeContext> makeEglContext() {
    return std::make_unique<EglContext>();
}

}  // namespace render

#else

std::unique_ptr<render::NativeContext> render::makeEglContext() {
    throw SystemError("this globular was built without EGL (libegl-dev); use the osmesa backend");
}

#endif
