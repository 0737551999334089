// Where OpenGL draws: Mesa's software renderer as a library (OSMesa), or a device that EGL knows, such as a GPU. Named
// on the command line and in messages. This header and context.h need no OpenGL headers.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace render {

/// The library that contexts come from.
enum class Backend { osmesa, egl };

struct Device {
    Backend backend = Backend::osmesa;
    /// Number of a device of EGL, as eglQueryDevicesEXT counts them. Below zero: EGL's first device that is a GPU, or
    /// else its software renderer.
    int index = -1;

    friend bool operator==(const Device&, const Device&) = default;
};

/// The name of a device: "osmesa", "egl" or, with a number, "egl:0".
std::string nameOf(const Device& device);

/// The device of a name; nothing if it is not the name of one.
std::optional<Device> deviceNamed(std::string_view name);

/// The names that deviceNamed() knows, for messages.
inline constexpr std::string_view kDeviceNames = "osmesa, egl, egl:N";

/// Whether contexts can come from this library in this build.
bool isInBuild(Backend backend);

/// What OpenGL says about itself on a device.
struct DeviceInfo {
    Device device;
    std::string problem;           ///< why no context can be made; empty if one can, and then the rest is known
    std::string renderer;          ///< GL_RENDERER, for example "llvmpipe (LLVM 15.0.6, 256 bits)"
    std::string version;           ///< GL_VERSION, for example "4.5 (Core Profile) Mesa 22.3.6"
    std::string vendor;            ///< GL_VENDOR
    bool isSoftware = false;       ///< whether it is one of Mesa's software renderers
    int largestTexture = 0;        ///< pixels along a side
    int largestTextureBuffer = 0;  ///< texels
    int smallestPoint = 0;         ///< pixels
    int largestPoint = 0;          ///< pixels
};

/// Makes a context on a device to find out.
DeviceInfo deviceInfo(const Device& device);

/// All devices that EGL lists, in its order. There are none in a build without EGL.
std::vector<DeviceInfo> eglDevices();

}  // namespace render
