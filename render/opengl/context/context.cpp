// What contexts of both libraries share: loading the functions, the required version, and the names.
#include "render/opengl/context/context.h"

#include <utility>

#include <fmt/format.h>

#include "render/opengl/context/context_native.h"
#include "render/picture/system_error.h"

namespace render {

namespace {

std::string stringOf(const Gl& gl, GLenum name) {
    const GLubyte* text = gl.GetString(name);
    return text == nullptr ? std::string("unknown") : std::string(reinterpret_cast<const char*>(text));
}

int integerOf(const Gl& gl, GLenum name) {
    GLint value = 0;
    gl.GetIntegerv(name, &value);
    return value;
}

std::unique_ptr<NativeContext> makeNative(const Device& device) {
    return device.backend == Backend::osmesa ? makeOsmesaContext() : makeEglContext(device.index);
}

}  // namespace

struct Context::Parts {
    std::unique_ptr<NativeContext> native;
    Gl gl;
    std::string renderer;
    std::string version;
};

Context::Context(const Device& device) : parts_(std::make_unique<Parts>()) {
    parts_->native = makeNative(device);
    const CurrentContext current(*this);
    parts_->gl = loadGl([this](const char* name) { return parts_->native->address(name); });
    parts_->renderer = stringOf(parts_->gl, GL_RENDERER);
    parts_->version = stringOf(parts_->gl, GL_VERSION);
    const int major = integerOf(parts_->gl, GL_MAJOR_VERSION);
    const int minor = integerOf(parts_->gl, GL_MINOR_VERSION);
    if (major * 10 + minor < 33)
        throw OpenGlError(fmt::format("OpenGL 3.3 is needed, '{}' offers {}.{}", parts_->renderer, major, minor));
}

Context::Context(Context&&) noexcept = default;
Context::~Context() = default;

void Context::makeCurrent() {
    parts_->native->makeCurrent();
}

void Context::release() {
    parts_->native->release();
}

const std::string& Context::rendererName() const {
    return parts_->renderer;
}

const std::string& Context::versionName() const {
    return parts_->version;
}

const Gl& Context::gl() const {
    return parts_->gl;
}

CurrentContext::~CurrentContext() {
    try {
        context_.release();
    } catch (const OpenGlError&) {
        // A destructor must not throw. The context stays bound, and the next makeCurrent() reports the error.
    }
}

bool isSoftwareRenderer(const std::string& name) {
    for (const char* known : {"llvmpipe", "softpipe", "swrast", "Software Rasterizer"})
        if (name.find(known) != std::string::npos) return true;
    return false;
}

DeviceInfo deviceInfo(const Device& device) {
    DeviceInfo info;
    info.device = device;
    try {
        Context context(device);
        const CurrentContext current(context);
        const Gl& gl = context.gl();
        info.renderer = context.rendererName();
        info.version = context.versionName();
        info.vendor = stringOf(gl, GL_VENDOR);
        info.isSoftware = isSoftwareRenderer(info.renderer);
        info.largestTexture = integerOf(gl, GL_MAX_TEXTURE_SIZE);
        info.largestTextureBuffer = integerOf(gl, GL_MAX_TEXTURE_BUFFER_SIZE);
        GLint points[2] = {0, 0};
        gl.GetIntegerv(GL_POINT_SIZE_RANGE, points);
        info.smallestPoint = points[0];
        info.largestPoint = points[1];
    } catch (const OpenGlError& error) {
        info.problem = error.what();
    }
    return info;
}

std::vector<DeviceInfo> eglDevices() {
    std::vector<DeviceInfo> devices;
    for (int index = 0; index < eglDeviceCount(); ++index) devices.push_back(deviceInfo({Backend::egl, index}));
    return devices;
}

}  // namespace render
