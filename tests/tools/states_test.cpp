// Tests pictures that are drawn from states: the same bytes as those of a run that simulates, and refusals of states
// that are not those of the scene.
#include <nlohmann/json.hpp>
#include <vector>

#include "tests/catch.h"
#include "tests/tools/moving_scene.h"
#include "tests/tools/program.h"

using program::run;
using program::textOf;
using Scene = program::MovingScene;

namespace {

namespace fs = std::filesystem;

void replaceIn(const fs::path& file, const std::string& text, const std::string& other) {
    std::string bytes = textOf(file);
    const std::size_t at = bytes.find(text);
    REQUIRE(at != std::string::npos);
    program::writeText(file, bytes.replace(at, text.size(), other));
}

}  // namespace

TEST_CASE("Pictures drawn from states are those of a run that simulates, byte for byte", "[states]") {
    const Scene scene;
    const auto births = scene.json("states/run.json");
    REQUIRE(births["births"] > 20);
    REQUIRE(births["deaths"] > 20);
    const std::string video = (scene.folder / "direct.mp4").string();
    for (const std::string look :
         {"--style spheres --quality final --set camera[0].shutter=0.8", "--style spheres --set look.color_by=speed",
          "--style spheres", "--style metaballs --quality draft --set look.skin=smooth"}) {
        REQUIRE(run(scene.draw("direct", "--overwrite --video " + video + " " + look)).code == 0);
        const std::string again = (scene.folder / "again.mp4").string();
        REQUIRE(run(scene.fromStates("again", "--overwrite --video " + again + " " + look)).code == 0);
        for (int frame = 0; frame < 20; ++frame) {
            INFO(look << ", frame " << frame);
            CHECK(scene.frame("direct", frame).size() > 500);
            CHECK(scene.frame("again", frame) == scene.frame("direct", frame));
        }
        CHECK(textOf(again) == textOf(video));
        CHECK(scene.json("again/manifest.json")["frames"] == scene.json("direct/manifest.json")["frames"]);
    }
    CHECK(scene.frame("direct", 4) != scene.frame("direct", 5));

    const auto direct = scene.json("direct/run.json");
    const auto drawn = scene.json("again/run.json");
    CHECK(drawn["drawn_from"]["states"] == scene.states);
    CHECK(drawn["state_hash"] == direct["state_hash"]);
    CHECK(drawn["scene_hash"] == direct["scene_hash"]);
    CHECK(drawn["frames"] == 20);
    CHECK(!drawn.contains("steps"));

    // Single frames, from standard output and after an early end.
    REQUIRE(
        run(scene.fromStates("some", "--style metaballs --quality draft --set look.skin=smooth --frames 7,18")).code ==
        0);
    CHECK(scene.frame("some", 18) == scene.frame("direct", 18));
    fs::remove(scene.folder / "some/frame-00007.png");
    REQUIRE(
        run(scene.fromStates("some", "--style metaballs --quality draft --set look.skin=smooth --frames 7,18 --resume"))
            .code == 0);
    CHECK(scene.frame("some", 7) == scene.frame("direct", 7));
}

TEST_CASE("States may be drawn in another way than the scene they were simulated of, but not of another scene",
          "[states]") {
    const Scene scene;
    const auto one = [&](const std::string& change) {
        return run(scene.fromStates("other", "--frames 3 --overwrite --set " + change));
    };
    for (const char* change :
         {"title=u", "duration=0.5", "camera[1].eye=[0,3,9]", "look.color_by=speed", "overlay.size=2",
          "look.size=[64,64]", "obstacle[0].visible=false", "material[0].color=#ff0000"}) {
        const auto outcome = one(change);
        INFO(change << ": " << outcome.err);
        CHECK(outcome.code == 0);
    }
    for (const char* change : {"seed=2", "physics.step=0.02", "material[0].bd=3", "emitter[0].rate=50"}) {
        const auto outcome = one(change);
        INFO(change << ": " << outcome.err);
        CHECK(outcome.code == 2);
        CHECK(outcome.err.find(scene.states + ": its states are of another scene (simulation_hash: ") !=
              std::string::npos);
    }
    CHECK(one("fps=24").err.find("fps: 20 there, 24 here") != std::string::npos);
    CHECK(one("duration=2").code == 0);  // of which frame 3 is there
    const auto longer = run(scene.fromStates("longer", "--set duration=1.2"));
    CHECK(longer.code == 1);
    CHECK(longer.err.find("has no states of frames 20-23;") != std::string::npos);
}

TEST_CASE("States that are missing or damaged are named", "[states]") {
    const Scene scene;
    const auto draw = [&](const std::string& more = "") { return run(scene.fromStates("out", more)); };
    fs::remove(scene.folder / "states/particles-00003.ply");
    fs::remove(scene.folder / "states/particles-00004.ply");
    fs::remove(scene.folder / "states/particles-00017.ply");
    auto outcome = draw();
    CHECK(outcome.code == 1);
    CHECK(outcome.err == "error: " + scene.states +
                             " has no states of frames 3-4,17; `globular simulate` writes them with --frames, or with "
                             "--resume if it ended early\n");
    CHECK(!fs::exists(scene.folder / "out"));

    const fs::path state = scene.folder / "states/particles-00009.ply";
    std::string bytes = textOf(state);
    bytes[bytes.size() - 30] ^= 1;
    program::writeText(state, bytes);
    outcome = draw("--frames 8-10");
    CHECK(outcome.code == 1);
    CHECK(outcome.err == "error: " + state.string() + " is damaged: it is not the file that " + scene.states +
                             "/manifest.json lists\n");
    CHECK(scene.frame("out", 8).size() > 500);  // frames before it are there
    CHECK(!fs::exists(scene.folder / "out/frame-00009.png"));

    CHECK(run(scene.draw("out", "--states " + (scene.folder / "nowhere").string())).err.find("holds no states") !=
          std::string::npos);
    CHECK(run(scene.draw("again", "--states " + (scene.folder / "out").string())).code == 2);  // pictures
    const auto same =
        run("render " + scene.file + " --states " + scene.states + " -o " + scene.states + " --overwrite --frames 1");
    INFO(same.err);
    CHECK(same.code == 2);
    CHECK(fs::exists(scene.folder / "states/particles-00005.ply"));
    replaceIn(scene.folder / "states/manifest.json", "\"version\":\"", "\"version\":\"0.0.");
    const auto old = draw("--frames 1 --set title=old --overwrite");
    CHECK(old.code == 0);
    CHECK(old.err.find("warning: the states in " + scene.states + " are of version 0.0.") == 0);
    CHECK(scene.json("out/run.json")["drawn_from"]["version"].get<std::string>().find("0.0.") == 0);
    replaceIn(scene.folder / "states/manifest.json", "\"simulation_hash\":", "\"x\":");
    CHECK(draw("--frames 1").err.find("its states are of an earlier version") != std::string::npos);
}
