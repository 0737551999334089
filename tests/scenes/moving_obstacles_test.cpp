// Tests that shapes and motions of obstacles reach the engine and the picture, and their messages.
#include "tests/catch.h"

#include <numbers>

#include "engine/obstacles/obstacle_surfaces.h"
#include "tests/scenes/scene_text.h"

using engine::Vec3;
using scenes_test::kBall;
using scenes_test::Lines;
using scenes_test::problemsOf;
using scenes_test::sceneOf;
using scenes_test::ScratchFolder;
using scenes_test::viewAt;

namespace {

/// A box as an obstacle below the ball; text that is appended starts in line 10.
const std::string kBox = kBall + "[[obstacle]]\nshape = \"box\"\ncenter = [0, -3, 0]\nsize = [4, 1, 2]\n";

double heightOver(const engine::Obstacles& obstacles, const Vec3& point, double time) {
    double height = 1e9;
    engine::forEachSurface(obstacles, point, time, 1e9,
                           [&](const engine::Surface& surface) { height = std::min(height, surface.height); });
    return height;
}

}  // namespace

TEST_CASE("an obstacle without motion has no pose") {
    const engine::Obstacles obstacles = sceneOf(kBox).setup.obstacles;
    CHECK(obstacles.motions.empty());
    CHECK(obstacles.areRecorded.empty());
    CHECK(sceneOf(kBox + "record = true\n").setup.obstacles.areRecorded == std::vector<bool>{true});
}

TEST_CASE("a turned box is turned in the engine and in the picture") {
    const scenes::Scene scene = sceneOf(kBox + "rotation = [0, 0, 90]\n");
    CHECK(heightOver(scene.setup.obstacles, Vec3(0, 0, 0), 0.0) == Approx(1.0));
    CHECK(heightOver(scene.setup.obstacles, Vec3(2, -3, 0), 0.0) == Approx(1.5));
    const render::View view = viewAt(scene, 0.0);
    CHECK(view.boxObstacles.empty());
    REQUIRE(view.meshObstacles.size() == 1);
    CHECK(view.meshObstacles[0].rotation[0].y == Approx(1.0));
    CHECK(view.meshObstacles[0].position.y == Approx(-3.0));
}

TEST_CASE("velocity, spin, pivot and until of an obstacle reach the engine") {
    const engine::Obstacles obstacles =
        sceneOf(kBox + "velocity = [1, 0, 0]\nspin = [0, 0.5, 0]\npivot = [0, -2, 0]\nuntil = 1.5\n").setup.obstacles;
    REQUIRE(obstacles.motions.size() == 1);
    const engine::Motion& motion = obstacles.motions[0];
    CHECK(motion.velocity == Vec3(1, 0, 0));
    CHECK(motion.spin.y() == Approx(std::numbers::pi));
    CHECK(motion.pivot == Vec3(0, -2, 0));
    CHECK(motion.until == 1.5);
    CHECK(obstacles.areRecorded == std::vector<bool>{true});
    CHECK(heightOver(obstacles, Vec3(0, 0, 0), 1.6) == 1e9);
}

TEST_CASE("an obstacle glides along its path, and so does its picture") {
    const scenes::Scene scene = sceneOf(kBox +
                                        "[[obstacle.key]]\ntime = 0.5\n[[obstacle.key]]\ntime = 1.5\n"
                                        "position = [0, -1.5, 0]\nrotation = [0, 0, 90]\n");
    CHECK(heightOver(scene.setup.obstacles, Vec3(0, 1, 0), 0.0) == Approx(3.5));
    CHECK(heightOver(scene.setup.obstacles, Vec3(0, 1, 0), 1.0) < 3.0);
    CHECK(heightOver(scene.setup.obstacles, Vec3(0, 1, 0), 2.0) == Approx(0.5));
    CHECK(viewAt(scene, 0.0).meshObstacles.at(0).position.y == Approx(-3.0));
    CHECK(viewAt(scene, 2.0).meshObstacles.at(0).position.y == Approx(-1.5));
    CHECK(viewAt(sceneOf(kBox + "spin = [0, 1, 0]\nuntil = 1\n"), 1.0).meshObstacles.empty());
}

TEST_CASE("an obstacle has a path or a constant motion, and the paper's walls have neither") {
    const std::string key = "[[obstacle.key]]\ntime = 1\n";
    CHECK(problemsOf(kBox + "velocity = [0, 1, 0]\n" + key) ==
          Lines{"pile.toml:10:12: velocity and [[obstacle.key]] exclude each other, give one"});
    CHECK(problemsOf(kBox + key + "[[obstacle.key]]\ntime = 0.5\n") ==
          Lines{"pile.toml:13:8: time is 0.5, must be after that of the key before, 1 (seconds)"});
    CHECK(problemsOf(kBox + "spin = [0, 1, 0]\n[physics]\nwall = \"paper\"\n") ==
          Lines{"pile.toml:10:8: spin does not apply to the paper's walls, which rest; leave out physics.wall"});
}

TEST_CASE("solids of revolution and meshes are obstacles") {
    const scenes::Scene bowl =
        sceneOf(kBall +
                "[[obstacle]]\nshape = \"revolution\"\nprofile = [[0, -2], [1, -2], [1.5, 0]]\nthickness = 0.1\n"
                "center = [0, 0.5, 0]\nedges = true\n");
    CHECK(heightOver(bowl.setup.obstacles, Vec3(0, 0.5, 0), 0.0) > 1.0);
    CHECK(heightOver(bowl.setup.obstacles, Vec3(0, -1.2, 0), 0.0) == Approx(0.25).margin(0.01));
    CHECK(viewAt(bowl, 0.0).meshObstacles.size() == 1);
    CHECK(viewAt(bowl, 0.0).edges.size() > 70);
    const scenes::Scene bare = sceneOf(
        kBall + "[[obstacle]]\nshape = \"cylinder\"\nradius = 1\nheight = 1\ncenter = [0, -3, 0]\nfaces = false\n");
    CHECK(heightOver(bare.setup.obstacles, Vec3(0, -2, 0), 0.0) == Approx(0.5));
    CHECK(viewAt(bare, 0.0).meshObstacles.empty());
}

TEST_CASE("a mesh obstacle that cannot be read is refused at its file") {
    const Lines lines = problemsOf(kBall + "[[obstacle]]\nshape = \"mesh\"\nfile = \"missing.obj\"\n");
    REQUIRE(lines.size() == 1);
    CHECK(lines[0].find("missing.obj") != std::string::npos);
}
