// EGL without a surface: contexts on GPUs, and on Mesa's software renderer where Mesa no longer includes OSMesa.
#include "render/opengl/context/context_native.h"
#include "render/picture/system_error.h"

#ifdef RENDER_HAS_EGL

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <vector>

namespace render {

namespace {

[[noreturn]] void fail(const char* tried) {
    throw OpenGlError(fmt::format("{} failed with EGL error 0x{:04x}", tried, eglGetError()));
}

/// Whether a list of names that are separated by spaces has a name.
bool lists(const char* names, std::string_view name) {
    const std::string all = fmt::format(" {} ", names == nullptr ? "" : names);
    return all.find(fmt::format(" {} ", name)) != std::string::npos;
}

class EglContext final : public NativeContext {
 public:
    /// @param display  of a device or of the surfaceless platform. It belongs to the process and is not
    /// reference-counted, so it is never terminated: another context may still use it.
    explicit EglContext(EGLDisplay display) : display_(display) {
        if (eglInitialize(display_, nullptr, nullptr) == EGL_FALSE) fail("eglInitialize");
        const char* extensions = eglQueryString(display_, EGL_EXTENSIONS);
        for (const char* needed : {"EGL_KHR_surfaceless_context", "EGL_KHR_no_config_context"})
            if (!lists(extensions, needed)) throw OpenGlError(fmt::format("EGL lacks the extension {}", needed));
        bindApi();
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

/// The devices of EGL in its order; none if it cannot list them.
std::vector<EGLDeviceEXT> allDevices() {
    const auto query = reinterpret_cast<PFNEGLQUERYDEVICESEXTPROC>(eglGetProcAddress("eglQueryDevicesEXT"));
    EGLint count = 0;
    if (!lists(eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS), "EGL_EXT_platform_device") || query == nullptr ||
        query(0, nullptr, &count) == EGL_FALSE || count <= 0)
        return {};
    std::vector<EGLDeviceEXT> devices(static_cast<std::size_t>(count));
    if (query(count, devices.data(), &count) == EGL_FALSE) return {};
    devices.resize(static_cast<std::size_t>(std::max(count, 0)));
    return devices;
}

/// Whether a device is Mesa's software renderer. It may have a file of a graphics card all the same.
bool isSoftwareDevice(EGLDeviceEXT device) {
    const auto stringOf =
        reinterpret_cast<PFNEGLQUERYDEVICESTRINGEXTPROC>(eglGetProcAddress("eglQueryDeviceStringEXT"));
    return stringOf != nullptr && lists(stringOf(device, EGL_EXTENSIONS), "EGL_MESA_device_software");
}

/// @param native  a platform's own handle: of a device, or null for the surfaceless platform
std::unique_ptr<NativeContext> contextOn(EGLenum platform, void* native) {
    const EGLDisplay display = eglGetPlatformDisplay(platform, native, nullptr);
    if (display == EGL_NO_DISPLAY) fail("eglGetPlatformDisplay");
    return std::make_unique<EglContext>(display);
}

std::string rendererOf(NativeContext& context) {
    context.makeCurrent();
    const auto getString = reinterpret_cast<PFNGLGETSTRINGPROC>(context.address("glGetString"));
    const GLubyte* name = getString == nullptr ? nullptr : getString(GL_RENDERER);
    const std::string text = name == nullptr ? "" : reinterpret_cast<const char*>(name);
    context.release();
    return text;
}

/// A context of a GPU.
/// @throws OpenGlError also if Mesa draws for the device on the CPU, for example with LIBGL_ALWAYS_SOFTWARE=1
std::unique_ptr<NativeContext> contextOnGpu(EGLDeviceEXT device) {
    std::unique_ptr<NativeContext> context = contextOn(EGL_PLATFORM_DEVICE_EXT, device);
    const std::string renderer = rendererOf(*context);
    if (isSoftwareRenderer(renderer)) throw OpenGlError(fmt::format("its renderer is {}", renderer));
    return context;
}

/// Tries places where EGL may draw until one of them gives a context.
class Attempts {
 public:
    template <class Make>
    void attempt(const std::string& place, const Make& make) {
        if (context_ != nullptr) return;
        try {
            context_ = make();
        } catch (const OpenGlError& error) {
            problems_ += fmt::format("{}{}: {}", problems_.empty() ? "" : "; ", place, error.what());
        }
    }

    std::unique_ptr<NativeContext> result() {
        if (context_ == nullptr) throw OpenGlError(fmt::format("EGL finds nothing to draw with ({})", problems_));
        return std::move(context_);
    }

 private:
    std::unique_ptr<NativeContext> context_;
    std::string problems_;
};

}  // namespace

std::unique_ptr<NativeContext> makeEglContext(int index) {
    const std::vector<EGLDeviceEXT> devices = allDevices();
    const int count = static_cast<int>(devices.size());
    if (index >= count)
        throw OpenGlError(fmt::format("there is no EGL device {}; EGL lists {} device{}, counted from 0", index, count,
                                      count == 1 ? "" : "s"));
    if (index >= 0) return contextOn(EGL_PLATFORM_DEVICE_EXT, devices[static_cast<std::size_t>(index)]);
    Attempts attempts;
    for (std::size_t k = 0; k < devices.size(); ++k)
        if (!isSoftwareDevice(devices[k]))
            attempts.attempt(fmt::format("egl:{}", k), [&] { return contextOnGpu(devices[k]); });
    for (std::size_t k = 0; k < devices.size(); ++k)
        if (isSoftwareDevice(devices[k]))
            attempts.attempt(fmt::format("egl:{}", k), [&] { return contextOn(EGL_PLATFORM_DEVICE_EXT, devices[k]); });
    attempts.attempt("without a device", [] { return contextOn(EGL_PLATFORM_SURFACELESS_MESA, nullptr); });
    return attempts.result();
}

int eglDeviceCount() {
    return static_cast<int>(allDevices().size());
}

}  // namespace render

#else

std::unique_ptr<render::NativeContext> render::makeEglContext(int) {
    throw OpenGlError("this globular was built without EGL (libegl-dev)");
}

int render::eglDeviceCount() {
    return 0;
}

#endif
