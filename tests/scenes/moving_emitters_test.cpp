// Tests that the keys of an emitter in motion reach the engine, and their messages.
#include "tests/catch.h"

#include <numbers>

#include "engine/state/emitters.h"
#include "tests/scenes/scene_text.h"

using engine::Vec3;
using scenes_test::kTop;
using scenes_test::Lines;
using scenes_test::problemsOf;
using scenes_test::sceneOf;

namespace {

/// An emitter; text that is appended starts in line 7.
const std::string kNozzle = kTop + "[[emitter]]\nposition = [1, 2, 3]\nvelocity = [0, -4, 0]\nrate = 5\n";

engine::Motion motionOf(const std::string& lines) {
    return sceneOf(kNozzle + lines).setup.emitters.at(0).motion;
}

}  // namespace

TEST_CASE("an emitter is at rest unless a key moves it") {
    CHECK(motionOf("").isIdentity());
    const engine::Motion motion = motionOf("travel = [0.5, 0, 0]\nspin = [0, 0.25, 0]\n");
    CHECK(motion.pivot == Vec3(1, 2, 3));
    CHECK(motion.velocity == Vec3(0.5, 0, 0));
    CHECK(motion.spin == Vec3(0, 0.5 * std::numbers::pi, 0));
    CHECK(motion.keys.empty());
    const std::string points = kTop + "[[emitter]]\npositions = [[4, 5, 6], [1, 1, 1]]\nrate = 5\nspin = [1, 0, 0]\n";
    CHECK(sceneOf(points).setup.emitters.at(0).motion.pivot == Vec3(4, 5, 6));
}

TEST_CASE("the keys of an emitter's path reach the engine") {
    const engine::Motion motion = motionOf(
        "[[emitter.key]]\ntime = 0.5\n"
        "[[emitter.key]]\ntime = 1\nposition = [2, 2, 3]\nrotation = [0, 0, 90]\n"
        "[[emitter.key]]\ntime = 2\nposition = [3, 2, 3]\n");
    REQUIRE(motion.keys.size() == 3);
    CHECK(motion.keys[0].time == 0.5);
    CHECK(motion.keys[0].position == Vec3(1, 2, 3));
    CHECK(motion.keys[0].angles == Vec3(0, 0, 0));
    CHECK(motion.keys[1].position == Vec3(2, 2, 3));
    CHECK(motion.keys[1].angles.z() == 90.0);
    CHECK(motion.keys[2].position == Vec3(3, 2, 3));
    CHECK(motion.keys[2].angles == motion.keys[1].angles);
}

TEST_CASE("an emitter has a path or a constant motion") {
    const std::string key = "[[emitter.key]]\ntime = 1\n";
    CHECK(problemsOf(kNozzle + "spin = [0, 1, 0]\n" + key) ==
          Lines{"pile.toml:7:8: spin and [[emitter.key]] exclude each other, give one"});
    CHECK(problemsOf(kNozzle + "travel = [0, 1, 0]\n" + key) ==
          Lines{"pile.toml:7:10: travel and [[emitter.key]] exclude each other, give one"});
    CHECK(problemsOf(kNozzle + "spin = [0, 41, 0]\n") ==
          Lines{"pile.toml:7:12: spin[1] is 41, must be -40 to 40 (turns/s)"});
    CHECK(problemsOf(kNozzle + key + "[[emitter.key]]\ntime = 0.5\n") ==
          Lines{"pile.toml:10:8: time is 0.5, must be after that of the key before, 1 (seconds)"});
}

TEST_CASE("an emitter whose path starts outside the world is refused") {
    CHECK(problemsOf(kNozzle + "[world]\nmaximum = [9, 9, 9]\n") == Lines{});
    CHECK(problemsOf(kNozzle + "[[emitter.key]]\ntime = 1\nposition = [9.5, 2, 3]\n[world]\nmaximum = [9, 9, 9]\n") ==
          Lines{"pile.toml:10:1: an emitter's point of emission at [9.5, 2, 3] is outside the world"});
}
