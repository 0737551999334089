// globular devices: lists where OpenGL can draw, for --gl.
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <vector>

#include "render/opengl/context/device.h"
#include "tools/commands/commands.h"
#include "tools/system/json.h"
#include "tools/system/process.h"
#include "tools/system/processors.h"
#include "tools/system/threads.h"

namespace tools {
namespace {

Json jsonOf(const render::DeviceInfo& info) {
    Json json = {{"device", render::nameOf(info.device)}};
    if (!info.problem.empty()) {
        json["problem"] = info.problem;
        return json;
    }
    json.update({{"renderer", info.renderer},
                 {"version", info.version},
                 {"vendor", info.vendor},
                 {"software", info.isSoftware},
                 {"largest_texture", info.largestTexture},
                 {"largest_texture_buffer", info.largestTextureBuffer},
                 {"point_sizes", {info.smallestPoint, info.largestPoint}}});
    return json;
}

/// @param indent  number of spaces before the lines after the first
std::string textOf(const render::DeviceInfo& info, std::size_t indent) {
    if (!info.problem.empty()) return "cannot be used: " + info.problem;
    return fmt::format(
        "{}{}\n{:{}}OpenGL {}; at most {} pixels along a texture, {} texels in a buffer, {} pixels across a point",
        info.renderer, info.isSoftware ? ", on the CPU" : "", "", indent, info.version, info.largestTexture,
        info.largestTextureBuffer, info.largestPoint);
}

/// What --gl may name: OSMesa, what EGL chooses, and every device that EGL lists.
std::vector<render::DeviceInfo> allDevices() {
    std::vector<render::DeviceInfo> devices = {render::deviceInfo({render::Backend::osmesa}),
                                               render::deviceInfo({render::Backend::egl})};
    for (const render::DeviceInfo& info : render::eglDevices()) devices.push_back(info);
    return devices;
}

void listDevices(bool asJson) {
    prepareMesa(usableProcessors());
    const std::vector<render::DeviceInfo> devices = allDevices();
    std::size_t width = 0;
    for (const auto& info : devices) width = std::max(width, render::nameOf(info.device).size());
    for (const auto& info : devices) {
        if (asJson)
            printJson(jsonOf(info));
        else
            printText(fmt::format("{:<{}}  {}\n", render::nameOf(info.device), width, textOf(info, width + 2)));
    }
}

}  // namespace

void addDevicesCommand(CLI::App& program) {
    CLI::App& command = *program.add_subcommand("devices", "where OpenGL can draw: the devices for --gl");
    const auto json = std::make_shared<bool>(false);
    command.add_flag("--json", *json, "one JSON object a line");
    command.footer(
        "egl is the first GPU that EGL lists, or else Mesa's software renderer.\n"
        "Example: globular devices");
    command.callback([json] { listDevices(*json); });
}

}  // namespace tools
