// Heat in scene files: from keys to the setup of a run, what is refused, and temperatures in particle files.
#include "tests/catch.h"

#include <fmt/format.h>

#include <cmath>

#include "engine/heat/heat_exchange.h"
#include "engine/run/advance.h"
#include "scenes/particles/formats.h"
#include "scenes/particles/particle_file.h"
#include "tests/scenes/scene_text.h"

using scenes_test::kBall;
using scenes_test::kTop;
using scenes_test::Lines;
using scenes_test::problemsOf;
using scenes_test::sceneOf;
using scenes_test::viewAt;

namespace {

const std::string kWax =
    "[[material]]\nname = \"wax\"\npreset = \"solid\"\nradius = 0.1\ncolor = [1, 1, 1]\ncapacity = 2000\n"
    "conductivity = 0.3\nmelting = 330\nmelting_range = 10\nlatent = 2e5\nmelts_to = \"melt\"\ntemperature = 310\n"
    "[[material]]\nname = \"melt\"\npreset = \"liquid\"\ncolor = [1, 0, 0]\ncapacity = 2000\n";

const std::string kMelting =
    kTop + "fps = 20\n" + kWax +
    "[[body]]\nshape = \"points\"\npositions = [[0, 1, 0], [1, 1, 0]]\n"
    "[[body]]\nshape = \"points\"\npositions = [[3, 1, 0]]\ntemperature = 335\n"
    "[[emitter]]\nposition = [0, 5, 0]\nvelocity = [0, -1, 0]\ntemperature = 400\n"
    "[[obstacle]]\nshape = \"plane\"\ntemperature = 500\n[[obstacle]]\nshape = \"sphere\"\n"
    "center = [9, 0, 0]\nradius = 1\n[air]\ntemperature = 290\nexchange = 12\nemissivity = 0.5\n";

}  // namespace

TEST_CASE("the keys of heat become the heat of a run") {
    const scenes::Scene scene = sceneOf(kMelting);
    const engine::Setup& setup = scene.setup;
    REQUIRE(setup.heat);
    CHECK(setup.heat->air.temperature == 290.0);
    CHECK(setup.heat->air.exchange == 12.0);
    CHECK(setup.heat->air.emissivity == 0.5);
    REQUIRE(setup.heat->obstacles.size() == 2);
    CHECK(setup.heat->obstacles[0] == 500.0);
    CHECK_FALSE(setup.heat->obstacles[1].has_value());
    CHECK(setup.emitters.at(0).temperature == 400.0);
    CHECK(setup.materials[0].thermal ==
          engine::Thermal{.capacity = 2000, .conductivity = 0.3, .melting = 330, .meltingRange = 10, .latent = 2e5});
    const auto temperature = [&](std::size_t p) { return engine::temperatureOf(setup.materials, setup.initial, p); };
    CHECK(temperature(0) == Approx(310.0));  // of the material
    CHECK(temperature(2) == Approx(335.0));  // of the body
}

TEST_CASE("a material melts in stages to the constants of another, at its own radius") {
    const scenes::Scene scene = sceneOf(kMelting);
    const std::vector<engine::Material>& materials = scene.setup.materials;
    REQUIRE(materials.size() == 19);  // the two, the melt at that radius, and sixteen stages
    REQUIRE(scene.setup.heat->melts.size() == 1);
    CHECK(scene.setup.heat->melts[0].first == 3);
    const engine::Material melt = engine::withRadius(*engine::materialPreset("liquid"), 0.1);
    CHECK(materials.back().repulsion == melt.repulsion);
    CHECK(materials.back().damping == melt.damping);
    CHECK(materials.back().mass == materials[0].mass);
    CHECK(materials.back().name == "wax, 100 % melted");
    CHECK(scene.materialColors.at(10) == engine::Vec3(1.0, 0.5, 0.5));  // the eighth of sixteen
    // Half of the particle of 335 K has melted.
    CHECK(scene.setup.initial.material == std::vector<std::uint32_t>{0, 0, 10});
}

TEST_CASE("many materials that melt do so in fewer stages, which fit the table of pairs") {
    std::string text = kTop + "[[body]]\nshape = \"ball\"\nradius = 0.5\n";
    for (const char* name : {"a", "b", "c", "d"})
        text += fmt::format("[[material]]\nname = \"{}\"\ncapacity = 1\nmelting = 300\nmelts_to = \"melt\"\n", name);
    text += "[[material]]\nname = \"melt\"\ncapacity = 1\nbd = 7\n";
    CHECK(sceneOf(text).setup.materials.size() == 5 + 4 * 8);
}

TEST_CASE("heat is exchanged in equal parts of a frame") {
    CHECK(sceneOf(kMelting).setup.heat->interval == Approx(0.025));
    CHECK(sceneOf(kMelting + "[physics]\nheat_step = 0.06\n").setup.heat->interval == Approx(0.05));
    CHECK(sceneOf(kMelting + "[physics]\nheat_step = 0.01\n").setup.heat->interval == Approx(0.01));
}

TEST_CASE("a scene without a heat capacity has no heat, and no keys of heat") {
    CHECK_FALSE(sceneOf(kBall).setup.heat.has_value());
    CHECK(sceneOf(kBall).setup.initial.enthalpy.empty());
    CHECK(problemsOf(kBall + "[air]\nexchange = 3\n") ==
          Lines{"pile.toml:7:12: exchange needs heat: give the materials a capacity (J/(kg K))"});
    CHECK(problemsOf(kBall + "temperature = 300\n") ==
          Lines{"pile.toml:6:15: temperature needs heat: give the materials a capacity (J/(kg K))"});
    CHECK(problemsOf(kBall + "[look]\ncolor_by = \"temperature\"\n") ==
          Lines{"pile.toml:7:12: color_by = \"temperature\" needs heat: give the materials a capacity (J/(kg K))"});
}

TEST_CASE("mistakes with heat are named at their place") {
    const std::string material = kBall + "[[material]]\nname = \"wax\"\n";
    CHECK(problemsOf(material + "capacity = 10\nlatent = 5\n") ==
          Lines{"pile.toml:9:10: latent needs a melting temperature"});
    CHECK(problemsOf(material + "capacity = 10\nmelting = 300\nmelts_to = \"wx\"\n") ==
          Lines{"pile.toml:10:12: there is no material with the name \"wx\""});
    CHECK(problemsOf(material + "capacity = 10\nmelting = 300\nmelts_to = \"wax\"\n") ==
          Lines{"pile.toml:10:12: a material cannot melt to itself"});
    CHECK(problemsOf(material + "capacity = 10\n[[material]]\nname = \"ice\"\n") ==
          Lines{"pile.toml:10:8: capacity is missing, every material of a scene with heat needs it (J/(kg K))"});
    CHECK(problemsOf(material + "capacity = 0\n") == Lines{"pile.toml:8:12: capacity is 0, must be > 0 (J/(kg K))"});
    CHECK(problemsOf(material + "capacity = 10\ntemperature = -3\n") ==
          Lines{"pile.toml:9:15: temperature is -3, must be 0 to 100000 (K)"});
}

TEST_CASE("colors show temperatures") {
    const std::string look =
        "[look]\ncolor_by = \"temperature\"\ncolors = [\"#000000\", \"#ffffff\"]\ncolor_range = [300, 340]\n";
    const render::View view = viewAt(sceneOf(kMelting + look), 0.0);
    REQUIRE(view.particles.size() >= 3);
    CHECK(view.particles[0].color.r == Approx(0.25F));
    CHECK(view.particles[2].color.r == Approx(0.875F));
}

TEST_CASE("particle files keep heat, and bodies take it from them") {
    const scenes::Scene scene = sceneOf(kMelting);
    engine::Simulation simulation = engine::start(scene.setup);
    engine::advance(simulation, 0.5);
    const scenes::StateStamp stamp{10, 0.5, scene.simulationHash};
    const auto state = scenes::decodeState(scenes::encodeParticles(simulation.particles, stamp), "a.ply");
    CHECK(state.particles.enthalpy == simulation.particles.enthalpy);
    scenes::ParticleFrame frame{simulation.particles, stamp, {}, scene.materialColors};
    for (const engine::Material& material : scene.setup.materials) frame.materialNames.push_back(material.name);
    for (std::size_t p = 0; p < simulation.particles.count(); ++p)
        frame.temperature.push_back(engine::temperatureOf(scene.setup.materials, simulation.particles, p));
    int read = 0;
    for (const scenes::ParticleFormat& format : scenes::particleFormats()) {
        INFO(format.name);
        const scenes::ParticleFile file = scenes::decodeParticles(format.encode(frame), "a");
        if (file.temperature.empty()) continue;
        ++read;
        REQUIRE(file.temperature.size() == frame.temperature.size());
        for (std::size_t p = 0; p < file.temperature.size(); ++p)
            CHECK(file.temperature[p] == Approx(frame.temperature[p]).epsilon(1e-6));
    }
    CHECK(read == 3);  // VTP, extended XYZ and PLY in single precision
}
