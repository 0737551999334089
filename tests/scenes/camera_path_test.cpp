// Tests camera paths: the list of keys, and an interpolation that is smooth and does not overshoot.
#include "tests/catch.h"

#include <cmath>
#include <random>

#include "scenes/model/camera_path.h"
#include "scenes/view/frame_view.h"
#include "tests/scenes/scene_text.h"

using engine::Vec3;
using scenes::cameraAt;
using scenes::CameraPath;
using scenes_test::kBall;
using scenes_test::Lines;
using scenes_test::problemsOf;
using scenes_test::sceneOf;

namespace {

/// Keys at 0, 1 and 2 s; the eye's x goes 0, 1, 4, its z has an extremum, the angle is constant.
const std::string kPath =
    "[[camera]]\ntime = 0\neye = [0, 1, 9]\nfov = 30\n"
    "[[camera]]\ntime = 1\neye = [1, 1, 11]\n"
    "[[camera]]\ntime = 2\neye = [4, 1, 10]\ntarget = [0, 1, 0]\n";

CameraPath randomPath(unsigned seed) {
    std::mt19937 random(seed);
    const auto uniform = [&random] { return static_cast<double>(random()) / 4294967296.0; };
    CameraPath path;
    double time = uniform();
    for (int key = 0; key < 9; ++key) {
        scenes::CameraPlacement placement;
        for (Vec3* vector : {&placement.eye, &placement.target, &placement.up})
            *vector = Vec3(uniform(), std::round(2.0 * uniform()), uniform());  // y often repeats
        placement.verticalFov = 0.2 + uniform();
        placement.halfHeight = 1.0 + uniform();
        path.push_back({time, placement});
        time += 0.05 + 2.0 * uniform();
    }
    return path;
}

std::vector<double> numbersOf(const scenes::CameraPlacement& camera) {
    std::vector<double> numbers = {camera.verticalFov, camera.halfHeight};
    for (const Vec3& vector : {camera.eye, camera.target, camera.up})
        for (int axis = 0; axis < 3; ++axis) numbers.push_back(vector[axis]);
    return numbers;
}

}  // namespace

TEST_CASE("a single camera does not move") {
    const scenes::Scene scene = sceneOf(kBall + "[camera]\neye = [1, 2, 3]\n");
    REQUIRE(scene.camera.size() == 1);
    for (const double time : {-1.0, 0.0, 0.7, 1e9}) CHECK(cameraAt(scene.camera, time).eye == Vec3(1.0, 2.0, 3.0));
}

TEST_CASE("a path passes through its keys and is constant before and after them") {
    const scenes::Scene scene = sceneOf(kBall + kPath);
    const auto eye = [&](double time) { return cameraAt(scene.camera, time).eye; };
    CHECK(eye(-5.0) == Vec3(0.0, 1.0, 9.0));
    CHECK(eye(0.0) == Vec3(0.0, 1.0, 9.0));
    CHECK(eye(1.0) == Vec3(1.0, 1.0, 11.0));
    CHECK(eye(2.0) == Vec3(4.0, 1.0, 10.0));
    CHECK(eye(99.0) == Vec3(4.0, 1.0, 10.0));
}

TEST_CASE("between keys a path follows the published cubic") {
    const scenes::Scene scene = sceneOf(kBall + kPath);
    // x: slopes 1 and 3 on both sides of the middle key give a derivative of 2/(1/1 + 1/3) = 1.5 there, 0 at the ends.
    // Half way 0.5 - 1.5/8 = 0.3125, and 2.5 + 1.5/8 = 2.6875.
    CHECK(cameraAt(scene.camera, 0.5).eye.x() == Approx(0.3125).epsilon(1e-15));
    CHECK(cameraAt(scene.camera, 1.5).eye.x() == Approx(2.6875).epsilon(1e-15));
    // z has an extremum at the middle key, so that it rises and falls like u^2 (3 - 2u): 5/32 of the way after a
    // quarter.
    CHECK(cameraAt(scene.camera, 0.25).eye.z() == Approx(9.0 + 2.0 * 5.0 / 32.0).epsilon(1e-15));
    CHECK(cameraAt(scene.camera, 1.75).eye.z() == Approx(10.0 + 5.0 / 32.0).epsilon(1e-15));
    // A number that does not change keeps its bits.
    CHECK(cameraAt(scene.camera, 0.3).verticalFov == scene.camera[0].placement.verticalFov);
    CHECK(cameraAt(scene.camera, 0.3).target == Vec3(0.0, 0.0, 0.0));
}

TEST_CASE("no number leaves the interval between its values at the keys") {
    for (unsigned seed = 1; seed <= 20; ++seed) {
        const CameraPath path = randomPath(seed);
        for (std::size_t key = 0; key + 1 < path.size(); ++key) {
            const auto from = numbersOf(path[key].placement);
            const auto to = numbersOf(path[key + 1].placement);
            for (int part = 0; part <= 50; ++part) {
                const double share = part / 50.0;
                const auto now = numbersOf(cameraAt(path, (1.0 - share) * path[key].time + share * path[key + 1].time));
                for (std::size_t k = 0; k < now.size(); ++k) {
                    INFO("seed " << seed << ", key " << key << ", number " << k << ", part " << part);
                    CHECK(now[k] >= std::min(from[k], to[k]) - 1e-14);  // rounding of numbers up to 2
                    CHECK(now[k] <= std::max(from[k], to[k]) + 1e-14);
                }
            }
        }
    }
}

TEST_CASE("the velocity does not jump at a key") {
    constexpr double kShort = 1e-6;
    for (unsigned seed = 1; seed <= 20; ++seed) {
        const CameraPath path = randomPath(seed);
        for (std::size_t key = 0; key < path.size(); ++key) {
            const double time = path[key].time;
            const auto before = numbersOf(cameraAt(path, time - kShort));
            const auto here = numbersOf(cameraAt(path, time));
            const auto after = numbersOf(cameraAt(path, time + kShort));
            const bool isEnd = key == 0 || key + 1 == path.size();
            for (std::size_t k = 0; k < here.size(); ++k) {
                INFO("seed " << seed << ", key " << key << ", number " << k);
                const double arriving = (here[k] - before[k]) / kShort;
                const double leaving = (after[k] - here[k]) / kShort;
                // Second derivatives are at most 12 changes / interval^2 = 12 * 2 / 0.05^2 = 9600 1/s^2, over 1e-6 s.
                CHECK(std::abs(leaving - arriving) < 0.01);
                if (isEnd) CHECK(std::abs(leaving) + std::abs(arriving) < 0.01);
            }
        }
    }
}

TEST_CASE("a camera inherits from the one before what it leaves out") {
    const scenes::Scene scene =
        sceneOf(kBall +
                "[[camera]]\ntime = 0\nprojection = \"orthographic\"\nhalf_height = 4\ntarget = [0, 1, 0]\n"
                "[[camera]]\ntime = 1\nhalf_height = 2\n[[camera]]\ntime = 2\neye = [5, 5, 5]\n");
    REQUIRE(scene.camera.size() == 3);
    for (const scenes::CameraKey& key : scene.camera) {
        CHECK(key.placement.projection == render::Projection::orthographic);
        CHECK(key.placement.target == Vec3(0.0, 1.0, 0.0));
    }
    CHECK(scene.camera[1].placement.halfHeight == 2.0);
    CHECK(scene.camera[2].placement.halfHeight == 2.0);
    CHECK(scene.camera[1].placement.eye == Vec3(0.0, 2.0, 10.0));
}

TEST_CASE("the view at a time has the camera of that time") {
    const scenes::Scene scene = sceneOf(kBall + kPath + "[look]\nground = true\n");
    const render::View view = scenes_test::viewAt(scene, 1.5);
    CHECK(view.camera.eye.x == 2.6875F);
    CHECK(view.camera.target.y == 0.5F);
    CHECK(view.ground->center == glm::vec3(0.0F));
}

TEST_CASE("overrides refer to the cameras of a path by number") {
    CHECK(sceneOf(kBall + kPath, {"camera[1].eye=[7, 7, 7]"}).camera.at(1).placement.eye == Vec3(7.0, 7.0, 7.0));
    CHECK(problemsOf(kBall + kPath, {"camera.fov=20"}) ==
          Lines{"--set camera.fov=20: camera is a list, write camera[0].fov"});
}

TEST_CASE("every camera of a path has a time, and the times increase") {
    CHECK(problemsOf(kBall + "[[camera]]\neye = [1, 2, 3]\n") == Lines{});
    CHECK(problemsOf(kBall + "[[camera]]\ntime = 1\n[[camera]]\neye = [1, 2, 3]\n") ==
          Lines{"pile.toml:8:1: time is missing, a camera on a path needs it (seconds)"});
    CHECK(problemsOf(kBall + "[[camera]]\ntime = 1\n[[camera]]\ntime = 1\n[[camera]]\ntime = 0.5\n") ==
          Lines{"pile.toml:9:8: time is 1, must be after that of the camera before, 1 (seconds)",
                "pile.toml:11:8: time is 0.5, must be after that of the camera before, 1 (seconds)"});
    CHECK(problemsOf(kBall + "[[camera]]\ntime = -1\n[[camera]]\ntmie = 2\n") ==
          Lines{"pile.toml:7:8: time is -1, must be >= 0 (seconds)",
                "pile.toml:9:1: unknown key \"camera.tmie\", did you mean \"time\"?"});
}

TEST_CASE("every camera of a path is checked") {
    CHECK(problemsOf(kBall + kPath + "[[camera]]\ntime = 3\neye = [0, 1, 0]\n") ==
          Lines{"pile.toml:17:1: target is where eye is, must be another point"});
    CHECK(problemsOf(kBall + kPath + "[[camera]]\ntime = 3\nup = [0, 0, 0]\n") ==
          Lines{"pile.toml:19:6: up is [0, 0, 0], must not be zero"});
    CHECK(problemsOf(kBall + kPath + "[[camera]]\ntime = 3\nprojection = \"orthographic\"\n") ==
          Lines{"pile.toml:19:14: projection is \"orthographic\", must stay \"perspective\" along the path"});
    CHECK(problemsOf(kBall + kPath + "[[camera]]\ntime = 3\nhalf_height = 2\n") ==
          Lines{"pile.toml:19:1: half_height does not apply to projection \"perspective\", only to orthographic"});
}

TEST_CASE("a path on which the picture jumps between two sound keys is warned of") {
    const auto warnings = [](const std::string& eye, const std::string& other) {
        const std::string target = "]\ntarget = [0, 1, 0]\n";
        return sceneOf(kBall + "[[camera]]\ntime = 0\neye = [" + eye + target + "[[camera]]\ntime = 2\neye = [" +
                       other + target)
            .warnings;
    };
    const Lines over = warnings("2, 8, 0", "-2, 8, 0");
    REQUIRE(over.size() == 1);
    CHECK(over[0].find("pile.toml:10:1: on the way to this key, at 1 s, the camera looks along up") == 0);
    const Lines through = warnings("0, 1, 6", "0.001, 1, -6");
    REQUIRE(through.size() == 1);
    CHECK(through[0].find("the camera passes through its target") != std::string::npos);
    CHECK(warnings("0, 1, 6", "6, 1, 0").empty());
    CHECK(warnings("2, 8, 0.5", "-2, 8, 0.5").empty());  // past the pole, but not through it
}
