// Names of devices, and which libraries the build has.
#include "render/opengl/context/device.h"

#include <charconv>

#include <fmt/format.h>

namespace render {

std::string nameOf(const Device& device) {
    if (device.backend == Backend::osmesa) return "osmesa";
    return device.index < 0 ? "egl" : fmt::format("egl:{}", device.index);
}

std::optional<Device> deviceNamed(std::string_view name) {
    if (name == "osmesa") return Device{Backend::osmesa};
    if (name == "egl") return Device{Backend::egl};
    constexpr std::string_view kNumbered = "egl:";
    if (!name.starts_with(kNumbered)) return std::nullopt;
    const char* const end = name.data() + name.size();
    int index = -1;
    const auto [stop, error] = std::from_chars(name.data() + kNumbered.size(), end, index);
    if (error != std::errc() || stop != end || index < 0) return std::nullopt;
    return Device{Backend::egl, index};
}

bool isInBuild([[maybe_unused]] Backend backend) {
#ifdef RENDER_HAS_OSMESA
    if (backend == Backend::osmesa) return true;
#endif
#ifdef RENDER_HAS_EGL
    if (backend == Backend::egl) return true;
#endif
    return false;
}

}  // namespace render
