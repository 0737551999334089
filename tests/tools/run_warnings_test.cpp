// What a run says went softly wrong.
#include "tools/run/run_warnings.h"

#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/catch.h"
#include "tests/tools/program.h"

using Lines = std::vector<std::string>;

TEST_CASE("A missed rate, a missed error and walls in trouble are said, and nothing else is", "[trouble]") {
    scenes::Scene scene;
    engine::Simulation simulation;
    CHECK(tools::troublesOf(scene, simulation).empty());
    CHECK(tools::troubleLine(scene, simulation).empty());
    engine::Emitter emitter;
    emitter.sites = {engine::Vec3::Zero()};
    emitter.interval = 0.125;
    simulation.setup.emitters = {emitter};
    simulation.emitters = {engine::initialState(emitter)};
    simulation.emitters[0].births = 4;  // of 16 that were due
    simulation.time = 15 * emitter.interval;
    scene.tables.hasRate = {true};
    simulation.setup.error = 0.05;
    simulation.automatic.intervalCount = 4;
    simulation.automatic.errorSum = 16.0;
    simulation.steps.held = 1;
    simulation.wallDepths.centersOutside = 3;
    CHECK(tools::troublesOf(scene, simulation) ==
          Lines{"emitter 1: asked 8/s, 2/s fit", "the error was 4 radii a second on average, 0.05 wanted",
                "1 contact was held at the barrier of an obstacle", "up to 3 particles were beyond a surface at once"});
    scene.tables.hasRate = {false};  // an emitter without a rate emits what fits
    simulation.steps.held = 0;
    simulation.wallDepths = {};
    simulation.automatic.errorSum = 4 * 0.06;  // a fifth above what is wanted is what estimates are good for
    CHECK(tools::troublesOf(scene, simulation).empty());
    simulation.automatic.errorSum = 4 * 0.07;
    CHECK(tools::troubleLine(scene, simulation) ==
          "trouble: the error was 0.07 radii a second on average, 0.05 wanted\n");
}

TEST_CASE("The summary and run.json of a run tell of a rate that did not fit", "[trouble]") {
    const program::Folder folder;
    const std::string path = (folder / "slow.toml").string();
    // Each particle takes 0.4 s to make room for the next one.
    std::ofstream(path) << "title = \"t\"\nduration = 1\nfps = 10\n[physics]\ngravity = [0, 0, 0]\n[material]\n"
                           "radius = 0.2\n[[emitter]]\nposition = [0, 0, 0]\nvelocity = [0, 1, 0]\ninterval = 0.02\n";
    const auto outcome = program::run("simulate " + path + " -o " + (folder / "a").string());
    INFO(outcome.out << outcome.err);
    REQUIRE(outcome.code == 0);
    CHECK(outcome.out.find("\ntrouble: ") != std::string::npos);
    CHECK(outcome.out.find("emitter 1: asked 50/s, ") != std::string::npos);
    CHECK(nlohmann::json::parse(program::textOf(folder / "a/run.json"))["troubles"].size() == 1);
}
