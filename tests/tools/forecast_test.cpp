// The forecast of `check`: births by the emitters' schedules, and the first frames.
#include "tools/run/forecast.h"
#include "scenes/build/read_scene.h"

#include <algorithm>
#include <chrono>
#include <filesystem>
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
    CHECK(run.out.find("\ntrouble: emitter 1: asked 50/s, 1") != std::string::npos);
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
    CHECK(preview.work.empty());
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
    CHECK(outcome.out.find("\ncut off    frame 1 was not done after 4 s and ") != std::string::npos);
    CHECK(outcome.out.find("\nwarning    " + path + ":9:1: ") != std::string::npos);
    CHECK(outcome.out.find("is its normal flipped?\n") != std::string::npos);
    // 1e9 steps, each of which takes some microseconds.
    CHECK(outcome.out.find("\ntime ") != std::string::npos);
    CHECK((outcome.out.find(" hours of simulating") != std::string::npos ||
           outcome.out.find(" minutes of simulating") != std::string::npos));
    CHECK(outcome.err == "");

    std::ofstream(path) << "title = \"t\"\nduration = 0.1\n[physics]\nstep = 0.01\n[[body]]\nshape = \"points\"\n"
                           "positions = [[0, 1, 0], [0, 1, 0]]\n";
    const auto json = nlohmann::json::parse(program::run("check --json " + path).out);
    CHECK(json["cut_off"].is_null());
    CHECK(json["warnings"].size() == 1);

    const auto secondsOfDrawing = [&](const std::string& size) {
        const auto said = nlohmann::json::parse(program::run("check --json --set look.size=" + size + " " + path).out);
        return said["seconds_drawing"].get<double>();
    };
    CHECK(secondsOfDrawing("[64,36]") > 0.0);
    CHECK(secondsOfDrawing("[2560,1440]") > 3.0 * secondsOfDrawing("[64,36]"));  // it has 1600 times the pixels
}

TEST_CASE("check says what moves, a line for each of the first twelve", "[forecast]") {
    const program::Folder folder;
    const std::string path = (folder / "s.toml").string();
    std::ofstream(path) << "title = \"t\"\nduration = 0.1\n[[body]]\nshape = \"ball\"\nradius = 0.3\n";
    CHECK(program::run("check " + path).out.find("\nmotion ") == std::string::npos);
    for (int k = 0; k < 14; ++k)
        std::ofstream(path, std::ios::app) << "[[obstacle]]\nshape = \"sphere\"\nradius = 1\nvelocity = [0, -1, 0]\n"
                                           << "center = [0, -" << 3 * k + 3 << ", 0]\n";
    const std::string text = program::run("check " + path).out;
    CHECK(text.find("\nmotion     obstacle 12 (sphere): moves at 1 m/s along -y\nmotion     ... 14 in all\n") !=
          std::string::npos);
    CHECK(text.find("obstacle 13 (") == std::string::npos);
    const auto json = nlohmann::json::parse(program::run("check --json " + path).out)["motions"];
    REQUIRE(json.size() == 14);
    CHECK(json[13]["number"] == 14);
    CHECK(json[13]["what"] == "obstacle");
    CHECK(json[13]["shape"] == "sphere");
    CHECK(json[13]["fastest"] == 1.0);
    CHECK(json[13]["text"] == "moves at 1 m/s along -y");
}

TEST_CASE("check says what ranks would gain, if it is asked", "[forecast]") {
    const auto ranks = [](const std::string& flags) {
        return nlohmann::json::parse(program::run("check --json measured/solid " + flags).out).value("ranks", nlohmann::json());
    };
    CHECK(ranks("").is_null());
    const nlohmann::json few = ranks("--ranks 2");
    const nlohmann::json many = ranks("--ranks 1000");
    CHECK(few["count"] == 2);
    CHECK(few["efficiency"].get<double>() > 2.0 * many["efficiency"].get<double>());
    CHECK(few["ghosts"].get<int>() > 0);
    CHECK(few["speedup"].get<double>() == Approx(2.0 * few["efficiency"].get<double>()));
    CHECK(program::run("check measured/solid --ranks 1000").out.find("fewer ranks or threads pay better\n") !=
          std::string::npos);
    CHECK(program::run("check measured/solid --ranks 0").code == 2);
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

TEST_CASE("check tells what starts in a surprising way, and --strict makes that an error", "[forecast]") {
    const program::Folder folder;
    const std::string path = (folder / "odd.toml").string();
    const std::string keys = "title = \"t\"\nduration = 0.1\n[physics]\nstep = 0.01\n[[body]]\nshape = \"points\"\n";
    std::ofstream(path) << keys << "positions = [[0, 1, 0]]\n[camera]\neye = [0, 0, 9]\ntarget = [0, 0, 18]\n"
                        << "[[obstacle]]\nshape = \"box\"\nminimum = [5, 0, 0]\nmaximum = [6, 1, 1]\n"
                        << "visible = false\nedges = true\n";
    const auto lenient = program::run("simulate " + path + " --quiet -o " + (folder / "a").string());
    INFO(lenient.err);
    CHECK(lenient.code == 0);
    CHECK(lenient.err.find("warning: " + path + ":8:1: the camera sees nothing") != std::string::npos);
    CHECK(lenient.err.find("warning: " + path + ":16:9: edges = true draws nothing") != std::string::npos);
    const std::vector<std::string> commands = {"check ", "simulate -o " + (folder / "b").string() + " ",
                                               "render -o " + (folder / "b").string() + " "};
    for (const std::string& command : commands) {
        const auto strict = program::run(command + path + " --strict");
        INFO(command << strict.err);
        CHECK(strict.code == 2);
        CHECK(strict.out.empty());
        CHECK(program::lineCount(strict.err) == 2);
        CHECK(strict.err.find("error: " + path + ":8:1: the camera sees nothing") != std::string::npos);
        CHECK(strict.err.find("error: " + path + ":16:9: edges = true draws nothing") != std::string::npos);
        CHECK_FALSE(std::filesystem::exists(folder / "b"));
    }
    std::ofstream(path) << keys << "positions = [[0, 1, 0]]\n";
    for (const std::string& command : {std::string("check "), "simulate --quiet -o " + (folder / "b").string() + " "})
        CHECK(program::run(command + path + " --strict").code == 0);
}

TEST_CASE("A forecast of a run that was not simulated to its end says how sure it is", "[forecast]") {
    const scenes::Scene scene = sceneWith("position = [0, 0, 0]\nvelocity = [0, 5, 0]\ninterval = 0.1\n");
    tools::Preview preview;
    preview.seconds = 6.0;
    preview.simulation.time = scenes::frameTime(scene, 10);
    preview.frames = 10;
    for (int frame = 0; frame < 10; ++frame) preview.work.push_back({8.0, 2.0, 1.0});
    const auto found = tools::forecastOf(scene, preview, std::nullopt);
    REQUIRE(found);
    // Ten frames of 0.6 s are known, and 19 are to come.
    CHECK(found->leastSeconds > 6.0);
    CHECK(found->leastSeconds < 6.0 + 19 * 0.6);
    CHECK(found->mostSeconds > 6.0 + 19 * 0.6);
    CHECK(found->likelySeconds() > found->leastSeconds);
    CHECK(found->likelySeconds() < found->mostSeconds);

    // Fewer frames tell less, and nothing but a part of the first frame nothing at all.
    preview.work.resize(2);
    preview.frames = 2;
    preview.seconds = 1.2;
    const auto unsure = tools::forecastOf(scene, preview, std::nullopt);
    REQUIRE(unsure);
    CHECK(unsure->mostSeconds / unsure->leastSeconds > found->mostSeconds / found->leastSeconds);
    preview.work.clear();
    preview.frames = 0;
    CHECK_FALSE(tools::forecastOf(scene, preview, std::nullopt));

    // With a fixed step the number of steps is known.
    scenes::Scene fixed = scene;
    fixed.setup.stepper = engine::StepperKind::velocityVerlet;
    fixed.setup.step = 1.0 / 300.0;  // ten a frame
    preview.isCutOff = true;
    preview.stepsInCutOff = 5;
    preview.seconds = 1.0;
    append(preview.simulation.particles, {});
    const auto nominal = tools::forecastOf(fixed, preview, std::nullopt);
    REQUIRE(nominal);
    CHECK(nominal->leastSeconds < 58.0);  // 290 steps of 0.2 s
    CHECK(nominal->mostSeconds > 58.0);

    // What was simulated to the end is known.
    preview.work.assign(29, {8.0, 2.0, 1.0});
    const auto known = tools::forecastOf(scene, preview, std::nullopt);
    REQUIRE(known);
    CHECK(known->leastSeconds == known->mostSeconds);
}

TEST_CASE("A column of a large scene is simulated in its place", "[forecast]") {
    const program::Folder folder;
    const std::string path = (folder / "dam.toml").string();
    std::ofstream(path) << "title = \"t\"\nduration = 1\n[[body]]\nshape = \"grid\"\ncounts = [30, 30, 10]\n"
                           "[[obstacle]]\nshape = \"plane\"\npoint = [0, -9, 0]\n";
    const auto column = tools::simulateColumn(scenes::loadScene(path, {}));
    REQUIRE(column);
    CHECK(column->frames > 0);
    CHECK(column->simulation.particles.count() <= 2000);
    CHECK(column->simulation.particles.count() > 1500);
    const std::vector<engine::Vec3>& start = column->simulation.setup.initial.position;
    const auto [low, high] = std::minmax_element(
        start.begin(), start.end(), [](const engine::Vec3& a, const engine::Vec3& b) { return a.y() < b.y(); });
    CHECK(high->y() - low->y() > 28.0 * 0.3);  // all layers of it, 0.3 m apart
    std::ofstream(path) << "title = \"t\"\nduration = 1\n[[body]]\nshape = \"grid\"\ncounts = [9, 9, 9]\n";
    CHECK_FALSE(tools::simulateColumn(scenes::loadScene(path, {})));
}

TEST_CASE("Times are said in words that show how sure they are", "[forecast]") {
    CHECK(tools::durationText(0.2, 0.2) == "about 1 s");
    CHECK(tools::durationText(6.0, 11.0) == "about 9 s");
    CHECK(tools::durationText(6.0, 40.0) == "6 to 40 s");
    CHECK(tools::durationText(170.0, 520.0) == "3 to 9 minutes");
    CHECK(tools::durationText(3600.0, 90000.0) == "1 to 25 hours");
}
