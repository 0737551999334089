// Contexts in a build without OpenGL: there are none. Compiled instead of the other files that need OpenGL's headers.
#include <stdexcept>

#include "render/opengl/context/context.h"
#include "render/picture/system_error.h"

namespace render {

namespace {

constexpr const char* kProblem = "this globular was built without OpenGL";

[[noreturn]] void failWithoutContext() {
    throw std::logic_error("render: there is no OpenGL context in this build");
}

}  // namespace

struct Context::Parts {};

Context::Context(const Device&) {
    throw OpenGlError(kProblem);
}

Context::Context(Context&&) noexcept = default;
Context::~Context() = default;

void Context::makeCurrent() {
    failWithoutContext();
}

void Context::release() {
    failWithoutContext();
}

const std::string& Context::rendererName() const {
    failWithoutContext();
}

const std::string& Context::versionName() const {
    failWithoutContext();
}

const Gl& Context::gl() const {
    failWithoutContext();
}

CurrentContext::~CurrentContext() = default;

DeviceInfo deviceInfo(const Device& device) {
    DeviceInfo info;
    info.device = device;
    info.problem = kProblem;
    return info;
}

std::vector<DeviceInfo> eglDevices() {
    return {};
}

}  // namespace render
