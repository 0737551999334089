// The choice of what draws: the flags --renderer and --gl, what a run records of them, and `globular devices`.
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "render/opengl/context/device.h"
#include "tests/catch.h"
#include "tests/tools/program.h"

using program::run;
using program::textOf;

namespace {

namespace fs = std::filesystem;

constexpr const char* kSmall = "render measured/fountain --size 160x90 --frames 0-3 --quiet -o ";

nlohmann::json jsonOf(const fs::path& path) {
    return nlohmann::json::parse(textOf(path));
}

/// The objects that `globular devices --json` prints.
std::vector<nlohmann::json> devices(const std::string& environment = "") {
    const auto outcome = run("devices --json", environment);
    CHECK(outcome.code == 0);
    CHECK(outcome.err.empty());
    std::vector<nlohmann::json> list;
    std::istringstream lines(outcome.out);
    for (std::string line; std::getline(lines, line);) list.push_back(nlohmann::json::parse(line));
    return list;
}

/// Without a list of drivers EGL has none.
constexpr const char* kNoEglDriver = "__EGL_VENDOR_LIBRARY_FILENAMES=/dev/null";

}  // namespace

TEST_CASE("--gl without the OpenGL renderer is wrong input", "[opengl]") {
    for (const char* command :
         {"render measured/liquid", "strip measured/liquid", "bench --filter draw", "render measured/liquid --renderer cpu"}) {
        const auto outcome = run(std::string(command) + " --gl egl");
        INFO(command);
        CHECK(outcome.code == 2);
        CHECK(outcome.err == "error: --gl egl: the CPU draws; --gl is for --renderer opengl\n");
    }
    CHECK(run("render measured/liquid --renderer opengl --gl vulkan").err.find("no such OpenGL device") != std::string::npos);
    CHECK(run("render measured/liquid --renderer vulkan").code == 2);
}

TEST_CASE("A run on the CPU records that no OpenGL has drawn", "[opengl]") {
    const program::Folder folder;
    REQUIRE(run(kSmall + (folder / "a").string()).code == 0);
    for (const auto& record : {jsonOf(folder / "a/run.json"), jsonOf(folder / "a/manifest.json")["run"]}) {
        CHECK(record["renderer"] == "cpu");
        CHECK(record.at("gl_renderer").is_null());
        CHECK(record.at("gl_version").is_null());
    }
    REQUIRE(run("simulate measured/powder --quiet --frames 0 -o " + (folder / "b").string()).code == 0);
    CHECK(jsonOf(folder / "b/run.json").at("renderer").is_null());
}

TEST_CASE("devices lists OSMesa, what EGL chooses, and EGL's devices", "[opengl]") {
    const auto list = devices();
    REQUIRE(list.size() >= 2);
    CHECK(list[0]["device"] == "osmesa");
    CHECK(list[1]["device"] == "egl");
    for (std::size_t k = 2; k < list.size(); ++k) CHECK(list[k]["device"] == "egl:" + std::to_string(k - 2));
    for (const auto& device : list) {
        INFO(device.dump());
        CHECK(device.contains("problem") != device.contains("renderer"));
        if (device.contains("problem")) continue;
        CHECK(device["software"].is_boolean());
        CHECK(device["largest_texture"] >= 1024);
        CHECK(device["largest_texture_buffer"] >= 65536);
        CHECK(device["point_sizes"].size() == 2);
        const std::string text = run("devices").out;
        CHECK(text.find(device["renderer"].get<std::string>()) != std::string::npos);
        CHECK(text.find(device["version"].get<std::string>()) != std::string::npos);
    }
}

TEST_CASE("figures draws with OpenGL where the build has OSMesa, else on the CPU", "[opengl]") {
    const program::Folder folder;
    const bool drawsWithOpenGl = render::isInBuild(render::Backend::osmesa);
    const std::string help = run("figures --help").out;
    CHECK(help.find(drawsWithOpenGl ? "(default: opengl)" : "(default: cpu)") != std::string::npos);
    // A device that does not exist ends the command, before anything is simulated, if OpenGL draws.
    const std::string onNone = "figures 4 --quiet -o " + (folder / "a").string() + " --gl egl:4711";
    CHECK(run(onNone).code == (drawsWithOpenGl ? 1 : 2));
    CHECK(run(onNone + " --renderer cpu").code == 2);
}

#ifdef RENDER_HAS_OPENGL

TEST_CASE("OpenGL that cannot be used is one line that says what to do", "[opengl]") {
    const program::Folder folder;
    for (const auto& [device, environment] :
         {std::pair<std::string, std::string>{"egl:4711", ""}, {"egl", kNoEglDriver}, {"egl:0", kNoEglDriver}}) {
        const auto outcome = run(kSmall + (folder / "a").string() + " --renderer opengl --gl " + device, environment);
        INFO(outcome.err);
        CHECK(outcome.code == 1);
        CHECK(program::lineCount(outcome.err) == 1);
        CHECK(outcome.err.find("error: OpenGL on " + device + " cannot be used: ") == 0);
        CHECK(outcome.err.ends_with("; without OpenGL: --renderer cpu\n"));
        CHECK_FALSE(fs::exists(folder / "a"));
    }
    const auto list = devices(kNoEglDriver);
    REQUIRE(list.size() == 2);
    CHECK(list[0].contains("renderer"));
    CHECK(list[1]["problem"].get<std::string>().find("EGL finds nothing to draw with") == 0);
}

TEST_CASE("OpenGL draws a run, repeats it byte for byte, and records the device", "[opengl]") {
    const program::Folder folder;
    const std::string onGl = " --renderer opengl";
    REQUIRE(run(kSmall + (folder / "a").string() + onGl).code == 0);
    REQUIRE(run(kSmall + (folder / "b").string() + onGl + " --threads 1").code == 0);
    for (const char* frame : {"frame-00000.png", "frame-00003.png"})
        CHECK(textOf(folder / "a" / frame) == textOf(folder / "b" / frame));
    const auto osmesa = devices()[0];
    for (const auto& record : {jsonOf(folder / "a/run.json"), jsonOf(folder / "a/manifest.json")["run"]}) {
        CHECK(record["renderer"] == "opengl");
        CHECK(record["gl_renderer"] == osmesa["renderer"]);
        CHECK(record["gl_version"] == osmesa["version"]);
    }
    REQUIRE(run(kSmall + (folder / "c").string() + onGl + " --gl egl").code == 0);
    CHECK(jsonOf(folder / "c/run.json")["gl_renderer"] == devices()[1]["renderer"]);
    const std::string strip = (folder / "strip.png").string();
    CHECK(run("strip measured/fountain --times 0.1,0.2 --size 160x90 --quiet -o " + strip + onGl).code == 0);
    CHECK(fs::exists(strip));
}

TEST_CASE("bench names the renderer of the frames that it has drawn, and only of these", "[opengl]") {
    const std::string command = "bench --filter \"frame honey\" --rounds 1 --renderer opengl";
    std::istringstream lines(run(command + " --json").out);
    std::string line;
    REQUIRE(std::getline(lines, line));
    CHECK_FALSE(nlohmann::json::parse(line).contains("renderer"));
    REQUIRE(std::getline(lines, line));
    const auto drawn = nlohmann::json::parse(line);
    CHECK(drawn["name"] == "draw frame");
    CHECK(drawn["renderer"] == "opengl");
    CHECK(drawn["gl_renderer"] == devices()[0]["renderer"]);
    CHECK(run(command).out.find("\ndraw frame, opengl      honey ") != std::string::npos);
}

TEST_CASE("Frames of another renderer or device are another run's", "[opengl]") {
    const program::Folder folder;
    const std::string into = kSmall + (folder / "a").string();
    REQUIRE(run(into).code == 0);
    for (const char* more : {"", " --resume"}) {
        const auto other = run(into + " --renderer opengl" + more);
        INFO(other.err);
        CHECK(other.code == 1);
        CHECK(other.err.find("holds frames of another run (renderer: \"cpu\" there, \"opengl\" here; gl_renderer: ") !=
              std::string::npos);
    }
    REQUIRE(run(into + " --renderer opengl --overwrite").code == 0);
    REQUIRE(run(into + " --renderer opengl --resume").code == 0);
    std::string manifest = textOf(folder / "a/manifest.json");
    const std::string version = devices()[0]["version"].get<std::string>();
    REQUIRE(manifest.find(version) != std::string::npos);
    program::writeText(folder / "a/manifest.json",
                       manifest.replace(manifest.find(version), version.size(), "3.3 Mesa 1"));
    const auto other = run(into + " --renderer opengl --resume");
    INFO(other.err);
    CHECK(other.code == 1);
    CHECK(other.err.find("gl_version: \"3.3 Mesa 1\" there, ") != std::string::npos);
}

#else

TEST_CASE("A build without OpenGL draws on the CPU and says what it lacks", "[opengl]") {
    const auto outcome = run("render measured/liquid --frames 0 --renderer opengl");
    CHECK(outcome.code == 1);
    CHECK(outcome.err ==
          "error: OpenGL on osmesa cannot be used: this globular was built without OpenGL; without OpenGL: --renderer "
          "cpu\n");
}

#endif
