// The forecast of `check`: births by the emitters' schedules, and the first frames.
#include "tools/run/forecast.h"
#include "scenes/build/read_scene.h"

#include <fstream>

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
    CHECK(tools::plannedBirths(sceneWith(points)) == 20);
    CHECK(tools::plannedBirths(sceneWith(points + "pick = \"random\"\n")) == 10);
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
