// The forecast of `check`: births by the emitters' schedules, and the first frames.
#include "tools/run/forecast.h"
#include "scenes/build/read_scene.h"

#include <chrono>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/catch.h"
#include "tests/tools/program.h"

namespace {

/// A scene of 30 frames, the last at 29/30 s, with the keys of one emitter.
scenes::Scene sceneWith(const std::string& emitter) {
    const program::Folder folder;
    const std::string path = (folder / "scene.toml").string();
    std::ofstream(path) << "title = \"t\"\nduration = 1\nfps = 30\n[[emitter]]\n" << emitter;
    return scenes::loadScene(path, {});
}

}  // namespace

TEST_CASE("Births are counted as the schedule has them", "[forecast]") {
    const std::string point = "position = [0, 0, 0]\ninterval = 0.1\n";
    // At 0, 0.1, ..., 0.9 s.
    CHECK(tools::plannedBirths(sceneWith(point)) == 10);
    CHECK(tools::plannedBirths(sceneWith(point + "start = 0.35\n")) == 7);
    CHECK(tools::plannedBirths(sceneWith(point + "until = 0.3\n")) == 3);  // a birth at `until` is too late
    CHECK(tools::plannedBirths(sceneWith(point + "count = 4\n")) == 4);
    CHECK(tools::plannedBirths(sceneWith(point + "start = 0.99\n")) == 0);
    const std::string points = "positions = [[0, 0, 0], [5, 0, 0]]\ninterval = 0.1\n";
    CHECK(tools::plannedBirths(sceneWith(points + "pick = \"all\"\n")) == 20);
    CHECK(tools::plannedBirths(sceneWith(points + "pick = \"random\"\n")) == 10);
    // The second point is 0.05 s behind. Its last emission is due at 0.95 s, before the last frame at 0.967 s, but slow
    // particles are emitted in groups, here at 0.1 0.2 ... s.
    CHECK(tools::plannedBirths(sceneWith(points + "velocity = [0, 19, 0]\n")) == 20);
    CHECK(tools::plannedBirths(sceneWith(points)) == 19);
    CHECK(tools::plannedBirths(sceneWith(points + "cluster = 7\npick = \"all\"\n")) == 140);
    CHECK(tools::plannedBirths(sceneWith(points + "cluster = 7\ncount = 20\n")) == 14);
}

TEST_CASE("check, the last line of a run and run.json say what of a rate fits", "[forecast]") {
    const program::Folder folder;
    const std::string path = (folder / "jet.toml").string();
    const std::string out = (folder / "out").string();
    const auto write = [&](const std::string& rate) {
        std::ofstream(path) << "title = \"t\"\nduration = 2\nfps = 10\n[physics]\ngravity = [0, 0, 0]\n"
                               "[[emitter]]\nposition = [0, 0, 0]\nvelocity = [0, 3, 0]\n"
                            << rate;
    };
    write("rate = 50\n");
    const auto checked = program::run("check " + path);
    INFO(checked.out << checked.err);
    CHECK(checked.out.find("\nwarning    " + path + ":6:1: emitter 1: asked 50/s, about 1") != std::string::npos);
    const auto run = program::run("simulate " + path + " -o " + out);
    INFO(run.out << run.err);
    CHECK(run.code == 0);
    CHECK(run.out.find(", emitter 1: asked 50/s, 1") != std::string::npos);
    CHECK(run.out.ends_with("/s fit\n"));
    std::ifstream file(folder / "out/run.json");
    const auto json = nlohmann::json::parse(file);
    const int asked = json["emitters"][0]["asked"].get<int>();
    const int born = json["emitters"][0]["born"].get<int>();
    CHECK(asked == 96);  // 0 0.02 ... 1.9 s
    CHECK(born > 15);    // at 3 m/s a particle needs 0.086 s for 0.26 m
    CHECK(born <= 23);
    CHECK(json["emitters"][0]["refused"] == asked - born);
    CHECK(json["refused_births"] == asked - born);

    write("");
    CHECK(program::run("check " + path).out.find("asked") == std::string::npos);
    const auto dense = program::run("simulate " + path + " --overwrite -o " + out);
    CHECK(dense.out.find("asked") == std::string::npos);
    std::ifstream again(folder / "out/run.json");
    CHECK(nlohmann::json::parse(again)["emitters"][0]["refused"] <= 1);  // particles push each other
}

TEST_CASE("The beginning of a run is simulated and measured", "[forecast]") {
    const scenes::Scene scene = sceneWith("position = [0, 0, 0]\nvelocity = [0, 5, 0]\ninterval = 0.1\n");
    const tools::Preview preview = tools::simulateBeginning(scene);
    CHECK(preview.unstable.empty());
    CHECK(preview.frames == scenes::frameCount(scene) - 1);  // two seconds are more than enough
    CHECK(preview.simulation.particles.count() == 10);
    CHECK(preview.mostParticles == 10);
    CHECK(preview.bytesPerParticle > 0);
    CHECK(tools::everyKind(scene).count() == 1);
}

TEST_CASE("A frame that takes too long is cut off", "[forecast]") {
    scenes::Scene scene = sceneWith("position = [0, 0, 0]\nvelocity = [0, 5, 0]\ninterval = 0.1\n");
    scene.setup.stepper = engine::StepperKind::velocityVerlet;
    scene.setup.step = 1e-9;  // 33 million steps for a frame
    const tools::Preview preview = tools::simulateBeginning(scene, 0.05);
    CHECK(preview.isCutOff);
    CHECK(preview.frames == 0);
    CHECK(preview.steps.count == 0);
    CHECK(preview.stepsInCutOff > 0);
    CHECK(preview.seconds >= 0.05);
    CHECK(preview.bytesPerParticle > 0);
}

TEST_CASE("check tells what starts in the wrong place, and comes to an end", "[forecast]") {
    const program::Folder folder;
    const std::string path = (folder / "slow.toml").string();
    std::ofstream(path) << "title = \"t\"\nduration = 1\n[physics]\nstepper = \"velocity-verlet\"\nstep = 1e-9\n"
                           "[[body]]\nshape = \"ball\"\nradius = 0.5\n[[obstacle]]\nshape = \"plane\"\n"
                           "normal = [0, -1, 0]\npoint = [0, -2, 0]\n";
    const auto start = std::chrono::steady_clock::now();
    const auto outcome = program::run("check " + path);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    INFO(outcome.out << outcome.err);
    CHECK(outcome.code == 0);
    CHECK(seconds < 20.0);  // ten, and as many for a machine with other work
    CHECK(outcome.out.find("\ncut off    frame 1 was not done after 5 s and ") != std::string::npos);
    CHECK(outcome.out.find("\nwarning    " + path + ":9:1: ") != std::string::npos);
    CHECK(outcome.out.find("is its normal flipped?\n") != std::string::npos);
    CHECK(outcome.out.find("\ntime ") == std::string::npos);
    CHECK(outcome.err == "");

    std::ofstream(path) << "title = \"t\"\nduration = 0.1\n[physics]\nstep = 0.01\n[[body]]\nshape = \"points\"\n"
                           "positions = [[0, 1, 0], [0, 1, 0]]\n";
    const auto json = nlohmann::json::parse(program::run("check --json " + path).out);
    CHECK(json["cut_off"].is_null());
    CHECK(json["warnings"].size() == 1);
}

TEST_CASE("check does not try a scene whose neighbor list does not fit into memory", "[forecast]") {
    const program::Folder folder;
    const std::string path = (folder / "dense.toml").string();
    // Two million particles within a cutoff: 2e12 pairs.
    std::ofstream(path) << "title = \"t\"\nduration = 1\n[[body]]\nshape = \"grid\"\ncounts = [200, 100, 100]\n"
                           "spacing = 0.0001\n";
    const auto outcome = program::run("check " + path);
    INFO(outcome.out << outcome.err);
    CHECK(outcome.code == 0);
    CHECK(
        outcome.out.find("\ncut off    the particles have 2e+06 neighbors on average at the start, and a list of them "
                         "takes 1.6e+04 GB of memory") != std::string::npos);
    CHECK(outcome.out.find("\nwarning    " + path + ":3:1: body 1 starts with about 2e+12 pairs") != std::string::npos);
}
