// Fuzzes overrides (--set): any lines either change the scene below or are rejected.
#include <cstddef>
#include <cstdint>
#include <sstream>
#include <string>
#include <vector>

#include "scenes/build/read_scene.h"

namespace {

constexpr const char* kScene = R"(
title = "t"
duration = 2.0
[material]
preset = "liquid"
[[body]]
shape = "grid"
counts = [2, 2, 2]
[[emitter]]
position = [0, 1, 0]
rate = 2.0
[[obstacle]]
shape = "plane"
[look]
style = "metaballs"
)";

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    std::istringstream text(std::string(reinterpret_cast<const char*>(data), size));
    scenes::Overrides overrides;
    for (std::string line; std::getline(text, line);) overrides.emplace_back(line);
    try {
        scenes::readScene(kScene, GLOBULAR_SOURCE "/tests/fuzz/fuzzed.toml", overrides,
                          {.particles = 1000, .frames = 1000, .pixels = 1e6});
    } catch (const scenes::InputError&) {
    }
    return 0;
}
