// A container holds what fills it, whatever the preset and however fine its particles.
#include "tests/catch.h"
#include "tests/scenes/scene_text.h"

#include <fmt/format.h>

#include <cstdint>

#include "engine/run/advance.h"

using engine::Vec3;

namespace {

/// A container half again as high as the cube of 14 radii that fills it.
/// @param radius  of the particles, m
std::string filledContainer(std::string_view preset, double radius) {
    return fmt::format(R"(title = "filled"
duration = 2
[physics]
error = 0.3
[material]
preset = "{}"
radius = {}
[[body]]
shape = "box"
minimum = [0, 0, 0]
maximum = [{size}, {size}, {size}]
[[obstacle]]
shape = "container"
minimum = [0, 0, 0]
maximum = [{size}, {height}, {size}]
)",
                       preset, radius, fmt::arg("size", 14.0 * radius), fmt::arg("height", 21.0 * radius));
}

/// What has become of a filled container after 2 s.
struct Outcome {
    int outside = 0;            ///< centers beyond its walls at the end
    std::uint64_t everOut = 0;  ///< most centers beyond a wall at once, at any time
    double deepest = 0.0;       ///< deepest penetration of a particle at any time, in radii
};

Outcome outcomeOf(std::string_view preset, double radius, const scenes::Overrides& overrides = {}) {
    const scenes::Scene scene = scenes_test::sceneOf(filledContainer(preset, radius), overrides);
    engine::Simulation simulation = engine::start(scene.setup);
    REQUIRE(simulation.particles.count() > 300);
    for (int frame = 1; frame <= 60; ++frame) engine::advance(simulation, frame / 30.0);
    Outcome outcome{.everOut = simulation.wallDepths.centersOutside, .deepest = simulation.wallDepths.deepest};
    const Vec3 corner = radius * Vec3(14.0, 21.0, 14.0);
    for (const Vec3& position : simulation.particles.position)
        outcome.outside += (position.array() < 0.0).any() || (position.array() > corner.array()).any();
    return outcome;
}

}  // namespace

TEST_CASE("a filled container holds every preset at any radius", "[walls][long]") {
    const auto holds = [](const engine::Material& preset, double share) {
        const Outcome outcome = outcomeOf(preset.name, share * preset.radius);
        INFO(preset.name << " at " << share << " of its radius: deepest " << outcome.deepest);
        CHECK(outcome.outside == 0);
        CHECK(outcome.everOut == 0);
        CHECK(outcome.deepest < 1.0);
    };
    for (const engine::Material& preset : engine::materialPresets())
        for (const double share : {1.0, 2.0 / 3.0, 1.0 / 3.0}) holds(preset, share);
    // The finer, the more steps; the three that the paper's walls held least are cheap.
    for (const char* name : {"liquid", "solid", "powder"}) holds(*engine::materialPreset(name), 1.0 / 6.0);
}

TEST_CASE("the scaled walls hold a substance that is too heavy for the paper's walls", "[walls]") {
    // The liquid's constants with particles of a third of its radius: 27 times as dense.
    const scenes::Overrides heavy = {"material.mass=1", "material.b1=0.01", "material.bd=1"};
    scenes::Overrides heavyInPaperWalls = heavy;
    heavyInPaperWalls.emplace_back("physics.wall=paper");
    const Outcome inPaperWalls = outcomeOf("liquid", 0.05, heavyInPaperWalls);
    CHECK(inPaperWalls.outside > 0);
    CHECK(inPaperWalls.everOut > 0);
    const Outcome outcome = outcomeOf("liquid", 0.05, heavy);
    CHECK(outcome.outside == 0);
    CHECK(outcome.everOut == 0);
}
