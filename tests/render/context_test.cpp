// Contexts of OpenGL: devices are known by name, each says what it can do, and a missing one says why.
#include "tests/catch.h"

#include <thread>

#include "render/opengl/context/context.h"
#include "render/picture/system_error.h"

using render::Backend;
using render::Device;

TEST_CASE("Devices are known by name", "[opengl]") {
    CHECK(render::deviceNamed("osmesa") == Device{Backend::osmesa});
    CHECK(render::deviceNamed("egl") == Device{Backend::egl});
    CHECK(render::deviceNamed("egl:0") == Device{Backend::egl, 0});
    CHECK(render::deviceNamed("egl:12") == Device{Backend::egl, 12});
    for (const char* name : {"osmesa", "egl", "egl:0", "egl:12"})
        CHECK(render::nameOf(render::deviceNamed(name).value()) == name);
    for (const char* wrong :
         {"", "vulkan", "EGL", "egl:", "egl:-1", "egl:+1", "egl:1x", "egl: 1", "egl:99999999999", "osmesa:0"}) {
        INFO(wrong);
        CHECK_FALSE(render::deviceNamed(wrong).has_value());
    }
}

#ifdef RENDER_HAS_OPENGL

namespace {

/// Whether OpenGL can draw there, and with what GL 3.3 asks of every implementation.
void checkUsable(const render::DeviceInfo& info) {
    INFO(render::nameOf(info.device) << ": " << info.problem);
    REQUIRE(info.problem.empty());
    CHECK_FALSE(info.renderer.empty());
    CHECK_FALSE(info.vendor.empty());
    CHECK(std::stod(info.version) >= 3.3);
    CHECK(info.largestTexture >= 1024);
    CHECK(info.largestTextureBuffer >= 65536);
    CHECK(info.smallestPoint >= 0);
    CHECK(info.largestPoint >= 1);
    const render::Context context(info.device);
    CHECK(context.rendererName() == info.renderer);
    CHECK(context.versionName() == info.version);
}

}  // namespace

TEST_CASE("OSMesa draws on the CPU", "[opengl]") {
    const render::DeviceInfo info = render::deviceInfo({Backend::osmesa});
    checkUsable(info);
    CHECK(info.isSoftware);
    CHECK(info.renderer.find("pipe") != std::string::npos);
}

TEST_CASE("EGL takes its first GPU, or else the software renderer", "[opengl]") {
    const render::DeviceInfo chosen = render::deviceInfo({Backend::egl});
    checkUsable(chosen);
    const std::vector<render::DeviceInfo> devices = render::eglDevices();
    std::string expected;
    for (std::size_t k = 0; k < devices.size(); ++k) {
        CHECK(devices[k].device == Device{Backend::egl, static_cast<int>(k)});
        if (!devices[k].problem.empty()) continue;
        checkUsable(devices[k]);
        if (expected.empty() && !devices[k].isSoftware) expected = devices[k].renderer;
    }
    CHECK(chosen.isSoftware == expected.empty());
    if (!expected.empty()) CHECK(chosen.renderer == expected);
}

TEST_CASE("A device that EGL does not list is named", "[opengl]") {
    CHECK_THROWS_AS(render::Context(Device{Backend::egl, 4711}), render::SystemError);
    const render::DeviceInfo info = render::deviceInfo({Backend::egl, 4711});
    CHECK(info.problem.find("there is no EGL device 4711; EGL lists ") == 0);
    CHECK(info.renderer.empty());
}

TEST_CASE("A context may be current on one thread after another, also after it was moved", "[opengl]") {
    for (const Backend backend : {Backend::osmesa, Backend::egl}) {
        render::Context first(Device{backend});
        render::Context context(std::move(first));
        for (int k = 0; k < 3; ++k)
            std::thread([&] {
                const render::CurrentContext current(context);
                CHECK_FALSE(context.rendererName().empty());
            }).join();
        const render::CurrentContext current(context);
        CHECK_FALSE(context.versionName().empty());
    }
}

#else

TEST_CASE("A build without OpenGL says so", "[opengl]") {
    for (const Device& device : {Device{Backend::osmesa}, Device{Backend::egl}, Device{Backend::egl, 0}}) {
        CHECK_THROWS_AS(render::Context(device), render::SystemError);
        CHECK(render::deviceInfo(device).problem == "this globular was built without OpenGL");
    }
    CHECK(render::eglDevices().empty());
}

#endif
