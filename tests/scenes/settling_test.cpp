// Simulations of what scenes promise: a scene moves alike at any resolution, and a column sinks as far as was
// predicted.
#include "tests/catch.h"
#include "tests/scenes/scene_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "engine/force_law/compression.h"
#include "engine/run/advance.h"

using engine::Vec3;
using scenes_test::sceneOf;

namespace {

/// What is measured of a dam that breaks.
struct DamMotion {
    double fallTime = 0.0;    ///< until the mean height is half of that at the start, s
    double front = 0.0;       ///< where the foremost twentieth begins after half a second, m
    double restHeight = 0.0;  ///< mean height at the end, m
};

/// A dam of the liquid that sinks by a third of its height before it breaks.
const std::string kDam = R"(title = "dam"
duration = 1.4
[physics]
gravity = [0, -9.81, 0]
stepper = "leapfrog"
step = 0.008
[material]
radius = 0.1
mass = 1
bd = 3
compression = 0.3
[[body]]
shape = "box"
minimum = [0.1, 0.1, 0.1]
maximum = [0.96, 1.25, 0.7]
jitter = 0.05
[[obstacle]]
shape = "container"
minimum = [0, 0, 0]
maximum = [2.4, 3, 0.8]
)";

/// Mean height over the floor. The lowest particles lie a radius above the floor and stand for the matter down to half
/// a layer below their centers, which is less.
double meanHeight(const engine::Particles& particles) {
    double sum = 0.0;
    for (const Vec3& position : particles.position) sum += position.y();
    const double radius = particles.radius.at(0);
    return sum / static_cast<double>(particles.count()) - radius + 0.5 * std::sqrt(2.0) * radius;
}

double frontOf(const engine::Particles& particles) {
    std::vector<double> x;
    for (const Vec3& position : particles.position) x.push_back(position.x());
    std::sort(x.begin(), x.end());
    return x.at(x.size() * 19 / 20);
}

DamMotion motionOf(const std::string& text, const scenes::Overrides& overrides) {
    const scenes::Scene scene = sceneOf(text, overrides);
    engine::Simulation simulation = engine::start(scene.setup);
    const double startHeight = meanHeight(simulation.particles);
    DamMotion motion;
    constexpr double kInterval = 0.02;
    double before = startHeight;
    for (int k = 1; k * kInterval <= scene.duration; ++k) {
        engine::advance(simulation, k * kInterval);
        const double height = meanHeight(simulation.particles);
        if (motion.fallTime == 0.0 && height < 0.5 * startHeight)
            motion.fallTime = kInterval * (k - (0.5 * startHeight - height) / (before - height));
        if (k == 25) motion.front = frontOf(simulation.particles);
        motion.restHeight = before = height;
    }
    return motion;
}

/// What differs by more than a tenth between two motions, with the values; empty if nothing does.
std::string differences(const DamMotion& a, const DamMotion& b) {
    std::string text;
    const auto compare = [&](const char* name, double x, double y) {
        if (std::abs(x - y) > 0.1 * std::min(x, y)) text += fmt::format("{}: {} and {}; ", name, x, y);
    };
    compare("fall time", a.fallTime, b.fallTime);
    compare("front", a.front, b.front);
    compare("height at rest", a.restHeight, b.restHeight);
    return text;
}

/// A column of 25 layers that fits between its walls, and is damped so that it comes to rest soon.
std::string columnText(const std::string& preset, double compression) {
    return fmt::format(R"(title = "column"
duration = 4
[physics]
gravity = [0, -9.81, 0]
error = 0.3
[material]
preset = "{}"
radius = 0.08
mass = 1
bd = 15
compression = {}
[[body]]
shape = "box"
minimum = [0, 0.08, 0]
maximum = [0.90511, 2.79530, 0.90511]
jitter = 0.02
[[obstacle]]
shape = "container"
minimum = [-0.08, 0, -0.08]
maximum = [0.98511, 9, 0.98511]
)",
                       preset, compression);
}

/// Mean over the columns of a grid, one particle wide, of the highest center, plus half a layer.
double levelOf(const engine::Particles& particles) {
    const double radius = particles.radius.at(0);
    std::map<std::pair<int, int>, double> highest;
    for (const Vec3& position : particles.position) {
        const auto cell = [&](double x) { return static_cast<int>(std::floor(x / (2.0 * radius))); };
        double& height = highest[{cell(position.x()), cell(position.z())}];
        height = std::max(height, position.y());
    }
    double sum = 0.0;
    for (const auto& [cell, height] : highest) sum += height;
    return sum / static_cast<double>(highest.size()) - radius + std::sqrt(2.0) * radius;
}

}  // namespace

TEST_CASE("a dam breaks alike at any resolution", "[settling][long]") {
    const DamMotion coarse = motionOf(kDam, {});
    for (const char* resolution : {"resolution=2", "resolution=4"}) {
        INFO(resolution);
        CHECK(differences(coarse, motionOf(kDam, {resolution})) == "");
    }
    // If b1 followed with the fifth power of the radius, the dam would be too stiff.
    std::string given = kDam;
    const std::string key = "compression = 0.3";
    given.replace(given.find(key), key.size(),
                  fmt::format("b1 = {}", 2.0 * sceneOf(kDam).setup.materials.at(0).repulsion));
    CHECK(differences(coarse, motionOf(given, {"resolution=2"})) != "");
}

TEST_CASE("a column sinks as far as predicted", "[settling][long]") {
    for (const auto& [preset, compression] : std::map<std::string, double>{{"liquid", 0.1}, {"oil", 0.2}}) {
        const scenes::Scene scene = sceneOf(columnText(preset, compression));
        const scenes::BodyColumn& column = scene.bodyColumns.at(0);
        const double predicted = engine::settledShare(column.material, column.shape) * column.shape.height;
        CHECK(predicted == Approx((1.0 - compression) * column.shape.height));
        engine::Simulation simulation = engine::start(scene.setup);
        for (int k = 1; k <= 20; ++k) engine::advance(simulation, 0.05 * k * scene.duration);
        INFO(preset);
        CHECK(levelOf(simulation.particles) == Approx(predicted).epsilon(0.03));
    }
}

TEST_CASE("pools of the built-in scenes keep nine tenths of their volume", "[settling][long]") {
    // The areas of the tank and of the mold, m^2.
    for (const auto& [name, area] : std::map<std::string, double>{{"gate", 8.6 * 2.4}, {"molten-metal", 3.3 * 1.0}}) {
        const std::string path = GLOBULAR_SOURCE "/scenes/library/" + name + ".toml";
        const scenes::Scene scene = scenes::loadScene(path, {{"resolution=1"}});
        engine::Simulation simulation = engine::start(scene.setup);
        engine::advance(simulation, scene.duration);
        const double radius = scene.setup.materials.at(0).radius;
        const auto count = static_cast<double>(simulation.particles.count());
        // Closest packing of spheres that touch.
        const double volume = count * 4.0 * std::sqrt(2.0) * radius * radius * radius;
        INFO(name);
        CHECK(2.0 * meanHeight(simulation.particles) * area > 0.9 * volume);
        CHECK(2.0 * meanHeight(simulation.particles) * area < 1.2 * volume);
    }
}
