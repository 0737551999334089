// Fuzzes the readers of particle files: any bytes are either rejected, or are particles that every format in double
// precision or in shortest text preserves.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "scenes/particles/formats.h"
#include "scenes/particles/particle_file.h"
#include "scenes/text/input_error.h"

namespace {

void checkRoundTrips(scenes::ParticleFile& file) {
    engine::Particles& particles = file.particles;
    // Only what is missing may be zero.
    if (!file.hasRadius) std::ranges::fill(particles.radius, 1.0);
    if (!file.hasMass) std::ranges::fill(particles.mass, 1.0);
    std::ranges::fill(particles.material, 0);
    const scenes::ParticleFrame frame{particles, {1, 0.5, "hash"}, {"a"}, {engine::Vec3::Zero()}};
    for (const scenes::ParticleFormat& format : scenes::particleFormats()) {
        if (format.name == "ply-float") continue;
        const scenes::ParticleFile again = scenes::decodeParticles(format.encode(frame), "again");
        if (again.particles.position != particles.position || again.particles.velocity != particles.velocity ||
            again.particles.radius != particles.radius || again.particles.mass != particles.mass)
            __builtin_trap();
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view bytes(reinterpret_cast<const char*>(data), size);
    scenes::ParticleFile file;
    try {
        file = scenes::decodeParticles(bytes, "fuzzed");
    } catch (const scenes::InputError&) {
        return 0;
    }
    checkRoundTrips(file);
    try {
        scenes::decodeState(bytes, "fuzzed");
    } catch (const scenes::InputError&) {
    }
    return 0;
}
