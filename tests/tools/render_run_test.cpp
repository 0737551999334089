// Whole runs of the program: the files it promises, the same bytes every time, video and frames that agree.
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/catch.h"
#include "tests/tools/program.h"

using program::run;
using program::textOf;

namespace {

namespace fs = std::filesystem;

/// A short, small run of a scene of metaballs with shadows, births and obstacles.
std::string fountainRun(const fs::path& folder, const std::string& more) {
    return "render fountain --size 160x90 --frames 0-9 --quiet -o " + folder.string() + " --video " + folder.string() +
           ".mp4 " + more;
}

std::vector<std::string> frameBytes(const fs::path& folder) {
    std::vector<std::string> frames;
    for (int k = 0; k < 10; ++k) frames.push_back(textOf(folder / ("frame-0000" + std::to_string(k) + ".png")));
    return frames;
}

}  // namespace

TEST_CASE("A run leaves every frame, a video and a complete run.json, and repeats itself byte for byte", "[tools]") {
    const program::Folder folder;
    REQUIRE(run(fountainRun(folder / "a", "")).code == 0);
    REQUIRE(run(fountainRun(folder / "b", "")).code == 0);
    REQUIRE(run(fountainRun(folder / "c", "--threads 1")).code == 0);
    REQUIRE(run(fountainRun(folder / "d", "--gl egl")).code == 0);
    const auto frames = frameBytes(folder / "a");
    for (const std::string& frame : frames) CHECK(frame.size() > 500);
    CHECK(frames[9] != frames[1]);
    CHECK(frameBytes(folder / "b") == frames);
    CHECK(frameBytes(folder / "c") == frames);
    CHECK(frameBytes(folder / "d") == frames);
    CHECK(textOf(folder / "a.mp4").size() > 1000);
    CHECK(textOf(folder / "b.mp4") == textOf(folder / "a.mp4"));
    CHECK(textOf(folder / "c.mp4") == textOf(folder / "a.mp4"));

    const auto json = nlohmann::json::parse(textOf(folder / "a/run.json"));
    for (const char* key : {"scene", "scene_hash", "version", "threads", "instruction_set", "gl_renderer", "particles",
                            "refused_births", "frames", "stepper", "steps", "seconds", "error_estimate", "energy",
                            "linear_momentum", "angular_momentum", "state_hash"})
        CHECK(json.contains(key));
    CHECK(json["frames"] == 10);
    CHECK(json["steps"]["count"] >= 9);  // at least one for each interval
    CHECK(json["particles"] > 100);
    const auto single = nlohmann::json::parse(textOf(folder / "c/run.json"));
    CHECK(single["threads"] == 1);
    CHECK(single["state_hash"] == json["state_hash"]);
    CHECK(single["scene_hash"] == json["scene_hash"]);
}

TEST_CASE("Leaving frames out changes none of those that are drawn", "[tools]") {
    const program::Folder folder;
    const std::string small = "render fountain --size 160x90 --quiet -o ";
    REQUIRE(run(small + (folder / "all").string() + " --frames 0-9").code == 0);
    REQUIRE(run(small + (folder / "last").string() + " --frames 9").code == 0);
    CHECK(textOf(folder / "last/frame-00009.png") == textOf(folder / "all/frame-00009.png"));
    CHECK(nlohmann::json::parse(textOf(folder / "last/run.json"))["state_hash"] ==
          nlohmann::json::parse(textOf(folder / "all/run.json"))["state_hash"]);
    REQUIRE(run("simulate fountain --frames 9 --quiet -o " + (folder / "states").string()).code == 0);
    CHECK(nlohmann::json::parse(textOf(folder / "states/run.json"))["state_hash"] ==
          nlohmann::json::parse(textOf(folder / "all/run.json"))["state_hash"]);
}

TEST_CASE("globular video makes the same film of the frames, and refuses a gap", "[tools]") {
    const program::Folder folder;
    REQUIRE(run(fountainRun(folder / "a", "")).code == 0);
    REQUIRE(run("video " + (folder / "a").string() + " --quiet -o " + (folder / "again.mp4").string()).code == 0);
    CHECK(textOf(folder / "again.mp4") == textOf(folder / "a.mp4"));
    fs::remove(folder / "a/frame-00004.png");
    const auto gap = run("video " + (folder / "a").string() + " -o " + (folder / "gap.mp4").string());
    CHECK(gap.code == 1);
    CHECK(gap.err.find("frame-00004.png") != std::string::npos);
    CHECK_FALSE(fs::exists(folder / "gap.mp4"));
}

TEST_CASE("globular simulate writes states that a scene can start from", "[tools]") {
    const program::Folder folder;
    REQUIRE(run("simulate powder --frames 0-3 --quiet -o " + (folder / "states").string()).code == 0);
    CHECK(fs::exists(folder / "states/particles-00003.ply"));
    std::ofstream(folder / "again.toml")
        << "title = \"again\"\nduration = 0.1\n[material]\npreset = \"powder\"\nmass = 0.1\n"
           "[[body]]\nshape = \"file\"\nfile = \"states/particles-00003.ply\"\nmaterial = \"powder\"\n";
    const auto check = run("check --json " + (folder / "again.toml").string());
    INFO(check.err);
    CHECK(check.code == 0);
    const auto written = nlohmann::json::parse(textOf(folder / "states/run.json"));
    CHECK(written["particles"] > 2 * 19);  // the first layer of both nozzles and part of the second
    CHECK(nlohmann::json::parse(check.out)["particles_at_start"] == written["particles"]);
}

TEST_CASE("--json prints one object a line", "[tools]") {
    const program::Folder folder;
    const auto outcome = run("render figure-1 --size 64x64 --frames 0-2 --json -o " + (folder / "a").string());
    CHECK(outcome.code == 0);
    CHECK(outcome.err == "");
    REQUIRE(program::lineCount(outcome.out) == 4);
    std::istringstream lines(outcome.out);
    nlohmann::json last;
    for (std::string line; std::getline(lines, line);) last = nlohmann::json::parse(line);
    CHECK(last["event"] == "done");
    CHECK(last["run"]["frames"] == 3);
}

TEST_CASE("Every command explains itself with an example", "[tools]") {
    for (const char* command :
         {"render", "simulate", "figures", "video", "compare", "approve", "check", "scenes", "schema"}) {
        const auto help = run(std::string(command) + " --help");
        INFO(command);
        CHECK(help.code == 0);
        CHECK(help.out.find(std::string("Example: globular ") + command) != std::string::npos);
    }
    CHECK(run("--version").out.rfind("globular ", 0) == 0);
    CHECK(run("scenes").out.find("figure-4") != std::string::npos);
    CHECK(run("schema").out.find("metaball_reach") != std::string::npos);
}
