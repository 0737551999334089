// Shutter and lens of a scene's cameras: their keys, and what of a scene moves while the shutter is open.
#include "tests/catch.h"

#include <cmath>

#include "tests/scenes/scene_text.h"

using scenes_test::kBall;
using scenes_test::kTop;
using scenes_test::Lines;
using scenes_test::problemsOf;
using scenes_test::sceneOf;
using scenes_test::viewAt;

namespace {

const std::string kFlying =
    kTop +
    "fps = 20\n[[material]]\nradius = 0.1\n[[body]]\nshape = \"points\"\npositions = [[0, 1, 0], [1, 1, 0]]\n"
    "velocity = [3, 0, -1]\n";

const std::string kWheel = "fps = 20\n" + kBall +
                           "[[obstacle]]\nshape = \"box\"\nminimum = [-1, -0.1, -0.1]\nmaximum = [1, 0.1, 0.1]\n"
                           "spin = [0, 0, 0.25]\n";

}  // namespace

TEST_CASE("shutter and lens are closed by default, and the view is that of one moment") {
    const render::View view = viewAt(sceneOf(kFlying), 0.5);
    CHECK_FALSE(view.shutter.has_value());
    CHECK(view.camera.aperture == 0.0F);
    CHECK(view.samplesPerAxis == 3);
    CHECK(sceneOf(kFlying).blurWarnings.empty());
}

TEST_CASE("an open shutter gives particles their velocities, around the moment of the frame") {
    const render::View view = viewAt(sceneOf(kFlying + "[camera]\nshutter = 0.5\n"), 0.5);
    REQUIRE(view.shutter.has_value());
    REQUIRE(view.shutter->velocities.size() == 2);
    for (const glm::vec3& velocity : view.shutter->velocities) CHECK(velocity == glm::vec3(3.0F, 0.0F, -1.0F));
    REQUIRE(view.shutter->moments.size() == 9);
    double sum = 0.0;
    double most = 0.0;
    for (const render::Moment& moment : view.shutter->moments) {
        sum += double(moment.time);
        most = std::max(most, std::abs(double(moment.time)));
    }
    CHECK(std::abs(sum) < 1e-7);
    // The last of nine equal parts of half of 1/20 s has its middle 4/9 of that after the frame's moment.
    CHECK(std::abs(most - 0.025 * 4.0 / 9.0) < 1e-7);
    CHECK(viewAt(sceneOf(kFlying + "[camera]\nshutter = 0.5\nsamples = 25\n"), 0.5).shutter->moments.size() == 25);
}

TEST_CASE("a scene in which nothing moves has no shutter") {
    CHECK_FALSE(viewAt(sceneOf(kBall + "[camera]\nshutter = 1\n"), 0.5).shutter.has_value());
}

TEST_CASE("obstacles turn while the shutter is open, and are where they are at each moment") {
    const render::View view = viewAt(sceneOf(kWheel + "[camera]\nshutter = 1\n"), 0.0);
    REQUIRE(view.shutter.has_value());
    REQUIRE(view.meshObstacles.size() == 1);
    for (const render::Moment& moment : view.shutter->moments) {
        REQUIRE(moment.meshObstacles.size() == 1);
        // 90 degrees a second, before the first frame too.
        const double angle = 0.5 * 3.14159265358979 * double(moment.time);
        const glm::vec3 axis = moment.meshObstacles[0].rotation[0];
        CHECK(glm::distance(axis, glm::vec3(std::cos(angle), std::sin(angle), 0.0)) < 1e-5F);
        CHECK(glm::distance(moment.meshObstacles[0].position, view.meshObstacles[0].position) < 1e-5F);
    }
}

TEST_CASE("a moving camera is where its path has it at each moment, its lens too") {
    const std::string path =
        "[[camera]]\ntime = 0\neye = [0, 0, 9]\nshutter = 0.5\naperture = 0.1\nfocus = 4\n"
        "[[camera]]\ntime = 1\neye = [4, 0, 9]\n[[camera]]\ntime = 2\neye = [8, 0, 9]\naperture = 0.3\n";
    const scenes::Scene scene = sceneOf(kBall + path);
    CHECK(scene.camera.at(1).placement.aperture == 0.1);
    CHECK(scene.camera.at(1).placement.focus == 4.0);
    CHECK(scene.camera.at(2).placement.aperture == 0.3);
    const render::View view = viewAt(scene, 1.0);
    CHECK(view.camera.focus == 4.0F);
    REQUIRE(view.shutter.has_value());
    for (const render::Moment& moment : view.shutter->moments) {
        const scenes::CameraPlacement there = scenes::cameraAt(scene.camera, 1.0 + double(moment.time));
        CHECK(std::abs(double(moment.camera.eye.x) - there.eye.x()) < 1e-5);
        CHECK(std::abs(double(moment.camera.aperture) - there.aperture) < 1e-6);
    }
    // Keys without a focus of their own have the target's as soon as another key has one.
    const scenes::Scene pulled =
        sceneOf(kBall + "[[camera]]\ntime = 0\neye = [0, 0, 9]\naperture = 0.1\n[[camera]]\ntime = 1\nfocus = 2\n");
    CHECK(pulled.camera.at(0).placement.focus == 9.0);
    CHECK(pulled.camera.at(1).placement.focus == 2.0);
    CHECK(sceneOf(kBall + "[camera]\naperture = 0.1\n").camera.at(0).placement.focus == 0.0);
}

TEST_CASE("mistakes of shutter, lens and samples are named with their positions") {
    const auto camera = [](const std::string& lines) { return problemsOf(kBall + "[camera]\n" + lines); };
    CHECK(camera("shutter = 1.5\n") == Lines{"pile.toml:7:11: shutter is 1.5, must be 0 to 1"});
    CHECK(camera("aperture = -1\n") == Lines{"pile.toml:7:12: aperture is -1, must be 0 to 100000000 (meters)"});
    CHECK(camera("focus = 0\n") == Lines{"pile.toml:7:9: focus is 0, must be > 0 and <= 100000000 (meters)"});
    CHECK(camera("samples = 20\n") ==
          Lines{"pile.toml:7:11: samples is 20, must be a square number, such as 16 or 25"});
    CHECK(camera("samples = 0\n") == Lines{"pile.toml:7:11: samples is 0, must be 1 to 1024"});
    CHECK(camera("projection = \"orthographic\"\naperture = 0.1\n") ==
          Lines{"pile.toml:8:1: aperture does not apply to projection \"orthographic\", only to perspective"});
    CHECK(problemsOf(kBall + "[[camera]]\ntime = 0\nsamples = 16\n[[camera]]\ntime = 1\nsamples = 25\n") ==
          Lines{"pile.toml:11:11: samples is 25, must stay 16 along the path"});
}

TEST_CASE("keys that will surprise are warned of") {
    CHECK(sceneOf(kBall + "[camera]\nfocus = 3\n").warnings ==
          Lines{"pile.toml:7:9: focus has no effect without an aperture above 0"});
    CHECK(sceneOf(kBall + "[camera]\nfocus = 3\naperture = 0.1\n").warnings.empty());
    CHECK(sceneOf(kBall + "[camera]\naperture = 0.1\nshutter = 0.5\n").blurWarnings ==
          Lines{"pile.toml:7:12: aperture = 0.1 blurs pictures of --quality final alone, these are sharp",
                "pile.toml:8:11: shutter = 0.5 blurs pictures of --quality final alone, these are sharp"});
    CHECK(sceneOf(kBall + "[camera]\naperture = 0\nshutter = 0\n").blurWarnings.empty());
    CHECK(sceneOf(kBall, {{"camera.shutter=0.5", "--set camera.shutter=0.5"}}).blurWarnings ==
          Lines{"--set camera.shutter=0.5: shutter = 0.5 blurs pictures of --quality final alone, these are sharp"});
}

TEST_CASE("shutter and lens do not change what is simulated") {
    const std::string with = kFlying + "[camera]\nshutter = 0.5\naperture = 0.1\nsamples = 16\n";
    CHECK(sceneOf(with).simulationHash == sceneOf(kFlying).simulationHash);
    CHECK(sceneOf(with).sceneHash != sceneOf(kFlying).sceneHash);
}
