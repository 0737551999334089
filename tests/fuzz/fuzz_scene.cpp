// Fuzzes the reader of scenes: any text is either a scene or a list of problems.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "scenes/build/read_scene.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    try {
        // Small limits, so that a scene that may take much memory is not reported.
        scenes::readScene({reinterpret_cast<const char*>(data), size}, GLOBULAR_SOURCE "/tests/fuzz/fuzzed.toml", {},
                          {.particles = 1000, .frames = 1000, .pixels = 1e6});
    } catch (const scenes::InputError&) {
    }
    return 0;
}
