// For programs that take positions in single precision alone: splashsurf, VTK's PLY reader, Blender.
#include <fmt/format.h>

#include <array>
#include <cstdint>

#include "scenes/particles/number_type.h"
#include "scenes/particles/ply.h"

namespace scenes {

std::string encodePlyFloat(const ParticleFrame& frame) {
    constexpr std::array<std::string_view, 9> kFloats = {"x",  "y",      "z",    "vx",        "vy",
                                                         "vz", "radius", "mass", "birth_time"};
    const engine::Particles& particles = frame.particles;
    std::string bytes = fmt::format(
        "ply\nformat binary_little_endian 1.0\ncomment globular particles\ncomment time {}\ncomment frame {}\n"
        "comment simulation_hash {}\nelement vertex {}\n",
        frame.stamp.time, frame.stamp.frame, frame.stamp.simulationHash, particles.count());
    for (const std::string_view name : kFloats) bytes += fmt::format("property float {}\n", name);
    if (!frame.temperature.empty()) bytes += "property float temperature\n";
    bytes +=
        "property int material\nproperty int id\nelement face 0\nproperty list uchar int vertex_indices\nend_header\n";
    for (std::size_t index = 0; index < particles.count(); ++index) {
        const auto put = [&](double number) { putBytes(bytes, static_cast<float>(number)); };
        for (const engine::Vec3& vector : {particles.position[index], particles.velocity[index]})
            for (int axis = 0; axis < 3; ++axis) put(vector[axis]);
        put(particles.radius[index]);
        put(particles.mass[index]);
        put(particles.birthTime[index]);
        if (!frame.temperature.empty()) put(frame.temperature[index]);
        putBytes(bytes, static_cast<std::int32_t>(particles.material[index]));
        putBytes(bytes, static_cast<std::int32_t>(particles.id[index]));
    }
    return bytes;
}

}  // namespace scenes
