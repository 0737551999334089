// Tests what follows from the size of particles: the constants of materials, the key resolution, and b1 from a
// compression.
#include "tests/catch.h"
#include "tests/scenes/scene_text.h"

#include <fmt/format.h>

#include <cmath>

#include "engine/force_law/compression.h"
#include "engine/force_law/pair_law.h"
#include "engine/state/bodies.h"

using engine::Vec3;
using namespace scenes_test;

namespace {

const engine::Material kLiquid = *engine::materialPreset("liquid");

engine::Material materialOf(const std::string& keys, const scenes::Overrides& overrides = {}) {
    return sceneOf(kBall + "[material]\n" + keys, overrides).setup.materials.at(0);
}

std::string noteOf(const std::string& text, const scenes::Overrides& overrides = {}) {
    return sceneOf(text, overrides).materialNotes.back();
}

}  // namespace

TEST_CASE("mass, b1 and bd follow from the radius unless they are given") {
    const engine::Material fine = materialOf("radius = 0.075\n");
    CHECK(fine.mass == Approx(kLiquid.mass / 8.0));
    CHECK(fine.repulsion == Approx(kLiquid.repulsion / 64.0));
    CHECK(fine.damping == Approx(kLiquid.damping / 2.0));
    const engine::Material given = materialOf("radius = 0.075\nmass = 3\nb1 = 4\nbd = 5\n");
    CHECK(given.mass == 3.0);
    CHECK(given.repulsion == 4.0);
    CHECK(given.damping == 5.0);
    const engine::Material same = materialOf("radius = 0.15\n");
    CHECK(same.mass == kLiquid.mass);
    CHECK(same.repulsion == kLiquid.repulsion);
    CHECK(same.damping == kLiquid.damping);
}

TEST_CASE("a body with particles of another radius has a material of its own") {
    const std::string body =
        "[[body]]\nshape = \"points\"\npositions = [[0, 0, 0]]\nparticle_radius = 0.3\n"
        "[[body]]\nshape = \"points\"\npositions = [[5, 0, 0]]\n"
        "[[body]]\nshape = \"points\"\npositions = [[9, 0, 0]]\nparticle_radius = 0.3\nparticle_mass = 7\n";
    const scenes::Scene scene = sceneOf(kTop + body);
    REQUIRE(scene.setup.materials.size() == 2);
    CHECK(scene.setup.initial.material == std::vector<std::uint32_t>{1, 0, 1});
    CHECK(scene.setup.initial.mass == std::vector<double>{8.0, 1.0, 7.0});
    CHECK(scene.setup.materials[1].repulsion == Approx(64.0 * kLiquid.repulsion));
    CHECK(scene.setup.materials[1].damping == Approx(2.0 * kLiquid.damping));
    CHECK(scene.materialColors.at(1) == scene.materialColors.at(0));

    const scenes::Scene own = sceneOf(kTop + body, {"material.b1=0.5", "material.mass=2"});
    CHECK(own.setup.materials.at(1).repulsion == 0.5);
    CHECK(own.setup.initial.mass == std::vector<double>{2.0, 2.0, 7.0});
}

TEST_CASE("the force between a material and its finer form is between the forces within each") {
    // At a tenth of compression. Between them, b1 is s^3 and the rest length (1 + s)/2 of the coarse one's, where s is
    // the ratio of the radii: the force is 16 s^3/(1 + s)^4 of the coarse one's, and s^2 of it within the fine one.
    const auto force = [](const engine::Material& material, double rest) {
        const auto law = engine::pairConstants<double>(material, rest);
        return 0.9 * rest * engine::pairCoefficient<engine::kConservative>(0.81 * rest * rest, 0.0, law);
    };
    const double coarse = force(kLiquid, 2.0 * kLiquid.radius);
    for (const double ratio : {0.1, 0.25, 0.5, 0.8}) {
        INFO(ratio);
        const engine::Material fine = engine::withRadius(kLiquid, ratio * kLiquid.radius);
        const double between = force(engine::mixed(kLiquid, fine), kLiquid.radius + fine.radius);
        CHECK(force(fine, 2.0 * fine.radius) == Approx(ratio * ratio * coarse));
        CHECK(between == Approx(16.0 * std::pow(ratio, 3.0) / std::pow(1.0 + ratio, 4.0) * coarse));
        CHECK(between > ratio * ratio * coarse);
        CHECK(between < coarse);
    }
}

TEST_CASE("resolution divides radii and spacings, and keeps the volume of bodies") {
    const std::string text = kTop +
                             "[material]\nmass = 0.1\nb1 = 0.04\n[[body]]\nshape = \"box\"\nminimum = [0, 0, "
                             "0]\nmaximum = [2, 3, 1.4]\nspacing = 0.27\n";
    const scenes::Scene coarse = sceneOf(text);
    for (const double resolution : {0.5, 2.0, 3.0, 2.5}) {
        INFO("resolution " << resolution);
        const scenes::Scene fine = sceneOf(text, {fmt::format("resolution={}", resolution)});
        const double volume = std::pow(resolution, 3.0);
        const engine::Material& material = fine.setup.materials.at(0);
        CHECK(material.radius == Approx(0.15 / resolution));
        CHECK(material.mass == Approx(0.1 / volume));
        CHECK(material.repulsion == Approx(0.04 / (volume * volume)));
        CHECK(material.damping == Approx(1.0 / resolution));
        const auto massOf = [](const scenes::Scene& scene) {
            double sum = 0.0;
            for (const double mass : scene.setup.initial.mass) sum += mass;
            return sum;
        };
        // 11, 15 and 7 layers times the resolution are rounded, at resolution 0.5 each by half a layer.
        const bool isWhole = resolution == std::floor(resolution);
        CHECK(massOf(fine) ==
              Approx(massOf(coarse)).epsilon(isWhole ? 0.01 : 6.0 / 5.5 * 8.0 / 7.5 * 4.0 / 3.5 - 0.99));
        CHECK(fine.bodyColumns.at(0).shape.height ==
              Approx(coarse.bodyColumns.at(0).shape.height).epsilon(isWhole ? 1e-9 : 0.5 / 7.5 + 1e-9));
    }
}

TEST_CASE("resolution 1 changes nothing") {
    const std::string text = kBall + "particle_radius = 0.1\n[[emitter]]\nposition = [5, 0, 0]\nrate = 3\n";
    const scenes::Scene plain = sceneOf(text);
    const scenes::Scene one = sceneOf(text, {"resolution=1"});
    CHECK(plain.setup.initial.position == one.setup.initial.position);
    CHECK(plain.setup.initial.mass == one.setup.initial.mass);
    CHECK(plain.setup.emitters.at(0).interval == one.setup.emitters.at(0).interval);
    CHECK(plain.warnings.empty());
}

TEST_CASE("resolution refines grids, given radii and masses, time steps and emitters") {
    const std::string text = kTop +
                             "[physics]\nstepper = \"leapfrog\"\nstep = 0.01\n[[body]]\nshape = \"grid\"\ncounts = [3, "
                             "4, 1]\nparticle_radius = 0.2\nparticle_mass = 16\n[[emitter]]\nshape = "
                             "\"disc\"\nposition = [5, 5, 0]\nvelocity = [0, -3, 0]\nradius = 0.7\ninterval = 0.1\n";
    const scenes::Scene coarse = sceneOf(text);
    const scenes::Scene fine = sceneOf(text, {"resolution=2"});
    CHECK(fine.setup.initial.count() == 6 * 8 * 2);
    CHECK(fine.setup.initial.radius.at(0) == 0.1);
    CHECK(fine.setup.initial.mass.at(0) == 2.0);
    CHECK(fine.setup.step == 0.005);
    const auto discharge = [](const scenes::Scene& scene) {
        const engine::Emitter& emitter = scene.setup.emitters.at(0);
        return static_cast<double>(emitter.sites.size()) / emitter.interval *
               scene.setup.materials.at(emitter.material).mass;
    };
    CHECK(discharge(fine) == Approx(discharge(coarse)));
    CHECK(static_cast<double>(fine.setup.emitters.at(0).sites.size()) ==
          Approx(4.0 * static_cast<double>(coarse.setup.emitters.at(0).sites.size())).epsilon(0.15));
}

TEST_CASE("what cannot be refined is named") {
    CHECK(
        problemsOf("title = \"t\"\nduration = 2\nresolution = 2\n[[body]]\nshape = \"points\"\npositions = [[0, 0, "
                   "0]]\n") ==
        Lines{"pile.toml:6:13: resolution is 2, but particles that are given one by one cannot be refined: use a box, "
              "a ball or another shape that is filled, or leave resolution at 1"});
    CHECK(problemsOf("title = \"t\"\nduration = 2\n[[body]]\nshape = \"file\"\nfile = \"a.ply\"\n", {"resolution=2"})
              .front()
              .find("pile.toml:5:8: resolution is 2") == 0);
    CHECK(problemsOf(kBall, {"resolution=0"}).size() == 1);
    CHECK(problemsOf(kBall + "particle_mass = 1e-30\n", {"resolution=10"}) ==
          Lines{"pile.toml:6:17: particle_mass would be 1e-33 at resolution 10, must be 1e-30 to 1e+30"});
    CHECK(problemsOf(kBall + "[material]\nmass = 1e-30\n", {"resolution=10"}) ==
          Lines{"pile.toml:7:8: the mass would be 1e-33, must be 1e-30 to 1e+30"});
    const scenes::Scene scene = sceneOf(kTop + "[[emitter]]\nposition = [0, 0, 0]\ninterval = 0.1\n", {"resolution=2"});
    REQUIRE(scene.warnings.size() == 1);
    CHECK(scene.warnings[0] ==
          "pile.toml:3:1: at resolution 2 the jets of points and lines of emission are thinner; use a disc or a box");
}

TEST_CASE("a compression chooses b1 for the tallest body of the material, or for a depth") {
    const std::string text = kTop +
                             "[[material]]\ncompression = 0.05\n[[material]]\nname = \"b\"\n[[body]]\nshape = "
                             "\"ball\"\nradius = 0.5\n[[body]]\nshape = \"box\"\nminimum = [3, 0, 0]\nmaximum = [4, 2, "
                             "1]\nspacing = 0.28\n[[body]]\nshape = \"ball\"\nradius = 9\nmaterial = \"b\"\n";
    const scenes::Scene scene = sceneOf(text);
    CHECK(engine::settledShare(scene.setup.materials.at(0), scene.bodyColumns.at(1).shape) == Approx(0.95));
    CHECK(scene.setup.materials.at(1).repulsion == kLiquid.repulsion);
    const engine::Material deep = sceneOf(text, {"material[0].depth=8"}).setup.materials.at(0);
    CHECK(engine::settledShare(deep, {.height = 8.0, .spacing = 0.28}) == Approx(0.95));
    const engine::Material emitted =
        sceneOf(kTop + "[material]\ncompression = 0.1\ndepth = 2\n[[emitter]]\nposition = [0, 0, 0]\nrate = 1\n")
            .setup.materials.at(0);
    CHECK(engine::settledShare(emitted, {.height = 2.0, .spacing = 0.3}) == Approx(0.9));
}

TEST_CASE("a b1 or a compression of the command line takes the place of the other one in the file") {
    const std::string compressed = kBall + "[material]\ncompression = 0.1\ndepth = 2\n";
    CHECK(sceneOf(compressed, {"material.b1=3"}).setup.materials.at(0).repulsion == 3.0);
    CHECK(noteOf(compressed, {"material.b1=3"}) == "");
    CHECK(sceneOf(kBall + "[material]\nb1 = 3\n", {"material.compression=0.1", "material.depth=2"})
              .setup.materials.at(0)
              .repulsion == sceneOf(compressed).setup.materials.at(0).repulsion);
    CHECK(problemsOf(kBall, {"material.b1=3", "material.compression=0.1"}).size() == 1);
}

TEST_CASE("contradictory keys of a compression are reported") {
    CHECK(problemsOf(kBall + "[material]\nb1 = 1\ncompression = 0.1\n") ==
          Lines{"pile.toml:8:15: b1 and compression exclude each other, give one"});
    CHECK(problemsOf(kBall + "[material]\ndepth = 1\n") ==
          Lines{"pile.toml:7:9: depth does nothing without compression, which chooses b1 for that depth"});
    CHECK(problemsOf(kBall + "[material]\ncompression = 0.1\n[physics]\ngravity = [0, 0, 0]\n") ==
          Lines{"pile.toml:7:15: compression needs gravity: without it nothing is compressed"});
    CHECK(problemsOf(kTop + "[material]\ncompression = 0.1\n[[emitter]]\nposition = [0, 0, 0]\nrate = 1\n") ==
          Lines{"pile.toml:4:15: compression needs a depth (meters): no body that is filled with a lattice tells it"});
    CHECK(problemsOf(kBall + "spacing = 0.35\n[material]\ncompression = 0.1\n") ==
          Lines{"pile.toml:8:15: compression is 0.1, but particles 0.35 m apart sink further, however strong their "
                "repulsion is: give the body a smaller spacing"});
}

TEST_CASE("notes say why the constants of a material are what they are") {
    CHECK(noteOf(kBall) == "");
    CHECK(noteOf(kBall + "[material]\nmass = 3\n") == "");
    CHECK(noteOf(kBall + "[material]\nradius = 0.06\n") ==
          "radius 0.06 is 0.4 times that of the preset liquid: mass 0.064, b1 4.1e-05, bd 0.4 follow");
    CHECK(noteOf(kBall + "[material]\nradius = 0.06\nmass = 1\nb1 = 1\n") ==
          "radius 0.06 is 0.4 times that of the preset liquid: bd 0.4 follows");
    CHECK(noteOf(kBall, {"resolution=2"}) ==
          "radius 0.075 at resolution 2 is 0.5 times that of the preset liquid: mass 0.125, b1 0.000156, bd 0.5 "
          "follow");
    CHECK(noteOf(kBall + "particle_radius = 0.3\n") ==
          "particle_radius 0.3 is 2 times the radius of the material liquid: mass 8, b1 0.64, bd 2 follow");
    CHECK(noteOf(kBall + "[material]\ncompression = 0.1\n").find("compression 0.1 of 1 m: b1 ") == 0);
}
