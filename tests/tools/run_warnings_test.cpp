// What a run says went softly wrong.
#include "tools/run/run_warnings.h"

#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/catch.h"
#include "tests/tools/program.h"

using Lines = std::vector<std::string>;

TEST_CASE("Refused births, a missed error and walls in trouble are said, and nothing else is", "[trouble]") {
    engine::Simulation simulation;
    CHECK(tools::troublesOf(simulation).empty());
    CHECK(tools::troubleLine(simulation).empty());
    simulation.emitters.push_back({.schedules = {}, .births = 36, .refusals = 12});
    simulation.setup.error = 0.05;
    simulation.automatic.estimateCount = 4;
    simulation.automatic.errorSum = 16.0;
    simulation.steps.held = 1;
    simulation.wallDepths.centersOutside = 3;
    CHECK(tools::troublesOf(simulation) == Lines{"12 births found no room when due, 36 came about",
                                                 "the error was 4 radii a second on average, 0.05 wanted",
                                                 "1 contact was held at the barrier of an obstacle",
                                                 "up to 3 particles were beyond a surface at once"});
    simulation.emitters.clear();
    simulation.steps.held = 0;
    simulation.wallDepths = {};
    simulation.automatic.errorSum = 4 * 0.06;  // a fifth above what is wanted is what estimates are good for
    CHECK(tools::troublesOf(simulation).empty());
    simulation.automatic.errorSum = 4 * 0.07;
    CHECK(tools::troubleLine(simulation) == "trouble: the error was 0.07 radii a second on average, 0.05 wanted\n");
}

TEST_CASE("The summary and run.json of a run tell of births that found no room", "[trouble]") {
    const program::Folder folder;
    const std::string path = (folder / "slow.toml").string();
    // Each particle takes 0.4 s to make room for the next one.
    std::ofstream(path) << "title = \"t\"\nduration = 1\nfps = 10\n[physics]\ngravity = [0, 0, 0]\n[material]\n"
                           "radius = 0.2\n[[emitter]]\nposition = [0, 0, 0]\nvelocity = [0, 1, 0]\ninterval = 0.02\n";
    const auto outcome = program::run("simulate " + path + " -o " + (folder / "a").string());
    INFO(outcome.out << outcome.err);
    REQUIRE(outcome.code == 0);
    CHECK(outcome.out.find("\ntrouble: ") != std::string::npos);
    CHECK(outcome.out.find(" births found no room when due, ") != std::string::npos);
    CHECK(nlohmann::json::parse(program::textOf(folder / "a/run.json"))["troubles"].size() == 1);
}
