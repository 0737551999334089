// Tests `globular mesh` as a user runs it: the files of a run, their formats, resuming, and what is said about
// metaballs.
#include <filesystem>
#include <nlohmann/json.hpp>

#include "render/mesh/isosurface.h"
#include "scenes/shapes/mesh_file.h"
#include "tests/catch.h"
#include "tests/tools/early_ends.h"
#include "tests/tools/moving_scene.h"

namespace fs = std::filesystem;
using program::Folder;
using program::run;
using program::textOf;

namespace {

/// Whether tests of meshes must be skipped.
bool lacksOpenVdb() {
    if (!render::openVdbVersion().empty()) return false;
    WARN("skipped: this build has no OpenVDB");
    return true;
}

constexpr const char* kEmitter =
    "title = \"drops\"\nduration = 1\nfps = 20\n[material]\npreset = \"liquid\"\nradius = 0.1\n"
    "[[emitter]]\nshape = \"point\"\nposition = [0, 2, 0]\nvelocity = [1, 0, 0]\nrate = 10\nstart = 0.2\n"
    "[look]\nstyle = \"metaballs\"\n";

std::map<std::string, std::string> meshesIn(const fs::path& folder) {
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::directory_iterator(folder))
        if (entry.path().filename().string().starts_with("mesh-"))
            files[entry.path().filename().string()] = textOf(entry.path());
    return files;
}

}  // namespace

TEST_CASE("A run writes a mesh for each frame, the same for any number of threads", "[mesh]") {
    if (lacksOpenVdb()) return;
    const Folder folder;
    program::writeText(folder / "drops.toml", kEmitter);
    const std::string scene = "mesh " + (folder / "drops.toml").string() + " --quiet -o ";
    for (const std::string format : {"ply", "obj", "vdb"}) {
        INFO(format);
        const std::string frames = " --frames 0-19:5 --format " + format;
        REQUIRE(run(scene + (folder / (format + "1")).string() + frames + " --threads 1").code == 0);
        REQUIRE(run(scene + (folder / (format + "2")).string() + frames + " --threads 2").code == 0);
        const auto meshes = meshesIn(folder / (format + "1"));
        CHECK(meshes.size() == 4);
        CHECK(meshes.count("mesh-00015." + format) == 1);
        CHECK(meshes == meshesIn(folder / (format + "2")));
    }
    const auto json = nlohmann::json::parse(textOf(folder / "ply1/run.json"));
    CHECK(json["mesh"]["format"] == "ply");
    CHECK(json["mesh"]["cell"] == 0.5);
    CHECK(json["mesh"]["cell_m"].get<double>() == Approx(0.05));
    CHECK(json["mesh"]["skin"] == "plain");
    const auto frames = json["mesh"]["frames"];
    REQUIRE(frames.size() == 4);
    // Nothing has been emitted at the first.
    CHECK(frames[0] == nlohmann::json({{"frame", 0}, {"triangles", 0}, {"vertices", 0}, {"volume", 0.0}}));
    CHECK(textOf(folder / "ply1/mesh-00000.ply").find("element vertex 0\n") != std::string::npos);
    CHECK(frames[3]["frame"] == 15);
    CHECK(frames[3]["triangles"] > 500);
    CHECK(frames[3]["volume"] > 0.0);
    const std::string ply = textOf(folder / "ply1/mesh-00015.ply");
    CHECK(ply.find("comment frame 15\ncomment time 0.75 s\ncomment scene_hash ") != std::string::npos);
    CHECK(ply.find("element face " + std::to_string(frames[3]["triangles"].get<int>()) + "\n") != std::string::npos);
}

TEST_CASE("A run of meshes is resumed, and does not mix with others", "[mesh]") {
    if (lacksOpenVdb()) return;
    const Folder folder;
    const auto meshes = [&](const std::string& name, const std::string& more = "") {
        return "mesh measured/powder --frames 2-20 --quiet --checkpoint 0 -o " + (folder / name).string() + " " + more;
    };
    REQUIRE(run(meshes("whole")).code == 0);
    early_ends::interrupted(meshes("a"), "KILL", early_ends::after(300), folder / "log");
    REQUIRE(run(meshes("a", "--resume")).code == 0);
    CHECK(meshesIn(folder / "a") == meshesIn(folder / "whole"));
    CHECK(meshesIn(folder / "a").size() == 19);

    fs::remove(folder / "a/mesh-00020.ply");
    const auto again = run(meshes("a", "--resume"));
    CHECK(again.code == 0);
    CHECK(again.err.find("mesh-00020.ply is missing") != std::string::npos);
    CHECK(meshesIn(folder / "a") == meshesIn(folder / "whole"));

    for (const char* other : {"--cell 0.7", "--format obj", "--set look.skin=smooth"}) {
        const auto outcome = run(meshes("a", other));
        INFO(other << ": " << outcome.err);
        CHECK(outcome.code == 1);
        CHECK(outcome.err.find("holds frames of another run") != std::string::npos);
    }
    const auto states = run("simulate measured/powder --frames 2 --quiet -o " + (folder / "a").string());
    CHECK(states.code == 1);
    // --overwrite removes the meshes of the earlier run, whatever their format.
    REQUIRE(run(meshes("a", "--format obj --overwrite")).code == 0);
    CHECK(meshesIn(folder / "a").size() == 19);
    CHECK(meshesIn(folder / "a").count("mesh-00002.obj") == 1);
    // What another program wrote is left alone.
    program::writeText(folder / "b/mesh-00003.ply", "mine");
    CHECK(run(meshes("b", "--overwrite")).code == 2);
    CHECK(textOf(folder / "b/mesh-00003.ply") == "mine");
}

TEST_CASE("A scene that is drawn as spheres gets a mesh, and is told of what", "[mesh]") {
    if (lacksOpenVdb()) return;
    const Folder folder;
    const std::string mesh = "mesh measured/powder --frames 0 --overwrite -o " + (folder / "a").string();
    const auto plain = run(mesh + " --set look.style=spheres");
    CHECK(plain.code == 0);
    CHECK(plain.err.find("the scene is drawn as spheres; the mesh is of metaballs with look.metaball_reach = 2.5") !=
          std::string::npos);
    CHECK(plain.err.find("look.skin = \"smooth\"\n") == std::string::npos);
    const auto given = run(mesh + " --set look.style=spheres --set look.skin=smooth --set look.metaball_reach=3");
    CHECK(given.err.find("look.metaball_reach = 3 and look.skin = \"smooth\"\n") != std::string::npos);
    CHECK(run(mesh + " --set look.style=metaballs").err.find("spheres") == std::string::npos);
}

TEST_CASE("Wrong flags of mesh are refused in one line", "[mesh]") {
    const Folder folder;
    for (const char* arguments : {"mesh measured/powder --cell 0", "mesh measured/powder --cell nan", "mesh measured/powder --cell 2",
                                  "mesh measured/powder --format stl", "mesh measured/powder --frames 100000", "mesh nosuchscene"}) {
        const auto outcome = run(std::string(arguments) + " -o " + (folder / "a").string());
        INFO(arguments << ": " << outcome.err);
        CHECK(outcome.code == 2);
        CHECK(program::lineCount(outcome.err) == 1);
        CHECK_FALSE(fs::exists(folder / "a"));
    }
}

TEST_CASE("A build without OpenVDB says so before it simulates", "[mesh]") {
    const std::string version = run("--version").out;
    if (!render::openVdbVersion().empty()) {
        CHECK(version.find("OpenVDB " + render::openVdbVersion()) != std::string::npos);
        return;
    }
    CHECK(version.find("without OpenVDB") != std::string::npos);
    const Folder folder;
    const auto outcome = run("mesh measured/powder -o " + (folder / "a").string());
    CHECK(outcome.code == 1);
    CHECK(outcome.err.find("this build has no OpenVDB") != std::string::npos);
    CHECK(program::lineCount(outcome.err) == 1);
    CHECK_FALSE(fs::exists(folder / "a"));
}

TEST_CASE("The version tells whether assimp is built in, and which", "[mesh]") {
    const std::string assimp = scenes::assimpVersion();
    const std::string expected = assimp.empty() ? "without assimp" : "with assimp " + assimp;
    CHECK(run("--version").out.find(expected + "\n") != std::string::npos);
}

TEST_CASE("Meshes of states are those of a run that simulates, byte for byte", "[mesh]") {
    if (lacksOpenVdb()) return;
    const program::MovingScene scene;
    const auto mesh = [&](const std::string& name, const std::string& more) {
        return run("mesh " + scene.file + " --frames 0-19:6 --quiet -o " + (scene.folder / name).string() + " " + more);
    };
    REQUIRE(mesh("direct", "").code == 0);
    REQUIRE(mesh("again", "--states " + scene.states).code == 0);
    const auto direct = meshesIn(scene.folder / "direct");
    CHECK(direct.size() == 4);
    CHECK(meshesIn(scene.folder / "again") == direct);
    const auto json = scene.json("again/run.json");
    CHECK(json["drawn_from"]["states"] == scene.states);
    CHECK(json["mesh"]["frames"] == scene.json("direct/run.json")["mesh"]["frames"]);

    // A damaged state ends the run after the meshes before it; meshes are no states; states are not overwritten.
    program::writeText(fs::path(scene.states) / "particles-00012.ply", "ply");
    CHECK(mesh("damaged", "--states " + scene.states).code == 1);
    CHECK(meshesIn(scene.folder / "damaged").size() == 2);
    CHECK(mesh("other", "--states " + (scene.folder / "direct").string()).code == 2);
    CHECK(mesh("states", "--overwrite --states " + scene.states).code == 2);
}
