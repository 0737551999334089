// Tests what is said of obstacles and emitters in motion, and the speeds of their surfaces against closed forms.
#include "tests/catch.h"

#include <numbers>

#include "scenes/model/motion_notes.h"
#include "tests/scenes/scene_text.h"

using scenes::MotionNote;
using scenes_test::kBall;
using scenes_test::sceneOf;

namespace {

constexpr double kPi = std::numbers::pi;

/// The note on a box of 2 x 1 x 1 m around (0, -3, 0) with these keys, over 0.1 s a frame, with particles of 0.1 m.
MotionNote noteOnBox(const std::string& keys) {
    const auto notes =
        scenes::motionNotes(sceneOf("fps = 10\n" + kBall +
                                    "spacing = 0.2\n[[material]]\npreset = \"liquid\"\nradius = 0.1\n"
                                    "[[obstacle]]\nshape = \"plane\"\npoint = [0, -9, 0]\n"
                                    "[[obstacle]]\nshape = \"box\"\ncenter = [0, -3, 0]\nsize = [2, 1, 1]\n" +
                                    keys));
    REQUIRE(notes.size() == 1);
    CHECK(notes[0].what == "obstacle");
    CHECK(notes[0].number == 2);
    CHECK(notes[0].shape == "box");
    REQUIRE(notes[0].fastest);
    CHECK(notes[0].radiiPerFrame.value() == Approx(notes[0].fastest.value() * 0.1 / 0.1));
    return notes[0];
}

}  // namespace

TEST_CASE("what is at rest has no note") {
    CHECK(scenes::motionNotes(sceneOf(kBall)).empty());
    CHECK(scenes::motionNotes(sceneOf(kBall + "[[obstacle]]\nshape = \"box\"\ncenter = [0, -3, 0]\nsize = [4, 1, 2]\n"
                                              "rotation = [0, 0, 30]\nrecord = true\n"))
              .empty());
}

TEST_CASE("a constant velocity is said with its direction, and how far it takes a surface in a frame") {
    CHECK(noteOnBox("velocity = [0, -0.8, 0]\n").text == "moves at 0.8 m/s along -y");
    CHECK(noteOnBox("velocity = [0, -0.8, 0]\n").fastest.value() == 0.8);
    CHECK(noteOnBox("velocity = [0.6, 0, -0.8]\nuntil = 1.5\n").text ==
          "moves at 1 m/s along (0.6, 0, -0.8) until 1.5 s, then is taken away");
    CHECK(noteOnBox("velocity = [3, 0, 0]\n").text == "moves at 3 m/s along +x; 3 particle radii a frame");
    CHECK(noteOnBox("until = 2\n").text == "is taken away at 2 s");
}

TEST_CASE("a spin is said in turns a second, with the speed of the corner that is farthest from the axis") {
    const MotionNote note = noteOnBox("spin = [0, 0, -0.1]\n");
    CHECK(note.fastest.value() == Approx(0.1 * 2 * kPi * std::hypot(1.0, 0.5)));
    CHECK(note.text ==
          "turns 0.1 times a second about the axis (0, 0, -1) through (0, -3, 0); up to 0.702 m/s at its "
          "surface");
    CHECK(
        noteOnBox("spin = [0, 1, 0]\npivot = [0, 0, 0]\n").text ==
        "turns once a second about the axis (0, 1, 0) through (0, 0, 0); up to 7.02 m/s at its surface, 7.02 particle "
        "radii a frame");
    // While it turns, a corner once moves into the direction of the velocity.
    const MotionNote both = noteOnBox("spin = [0, 0, 0.5]\nvelocity = [2, 0, 0]\n");
    CHECK(both.fastest.value() == Approx(2.0 + kPi * std::hypot(1.0, 0.5)).epsilon(2e-3));  // moments of 1/64 of a turn
    CHECK(
        both.text.rfind("moves at 2 m/s along +x and turns 0.5 times a second about the axis (0, 0, 1) through (0, -3, "
                        "0) at the start; ",
                        0) == 0);
}

TEST_CASE("a path is said with its keys, how far it leads and how fast") {
    // Between two keys a monotone cubic that is level at its ends is 1.5 times as steep as the line.
    const MotionNote moved = noteOnBox(
        "[[obstacle.key]]\ntime = 0.5\n[[obstacle.key]]\ntime = 1.5\nposition = [0, -2.5, "
        "0]\n");
    CHECK(moved.fastest.value() == Approx(0.75));
    CHECK(moved.text == "follows 2 keys from 0.5 to 1.5 s, farthest 0.5 m; up to 0.75 m/s at its surface");
    const MotionNote turned =
        noteOnBox("[[obstacle.key]]\ntime = 0\n[[obstacle.key]]\ntime = 6\nrotation = [0, 0, 90]\n");
    CHECK(turned.fastest.value() == Approx(1.5 * kPi / 2 / 6 * std::hypot(1.0, 0.5)));
    CHECK(turned.text == "follows 2 keys from 0 to 6 s, turned by up to 90 degrees; up to 0.439 m/s at its surface");
    CHECK(noteOnBox("[[obstacle.key]]\ntime = 1\n").text == "stays where its one key puts it");
}

TEST_CASE("a plane that turns has no speed, and an emitter has that of its nozzle") {
    const auto notes = scenes::motionNotes(
        sceneOf(kBall +
                "[[obstacle]]\nshape = \"plane\"\npoint = [0, -9, 0]\nspin = [0, 0, 0.1]\n[[emitter]]\nposition = "
                "[0, 5, 0]\nvelocity = [0, -2, 0]\n[[emitter]]\nposition = [1, 5, 0]\nvelocity = [0, -2, 0]\ntravel = "
                "[0, 0, 2]\nspin = [0, 1, 0]\n"));
    REQUIRE(notes.size() == 2);
    CHECK(!notes[0].fastest);
    CHECK(!notes[0].radiiPerFrame);
    CHECK(notes[0].text == "turns 0.1 times a second about the axis (0, 0, 1) through (0, -9, 0)");
    CHECK(notes[1].what == "emitter");
    CHECK(notes[1].number == 2);
    CHECK(notes[1].shape.empty());
    CHECK(notes[1].fastest.value() == Approx(2.0));  // of the one point of emission, on the axis
    CHECK(notes[1].text ==
          "moves at 2 m/s along +z and turns once a second about the axis (0, 1, 0) through (1, 5, 0) at "
          "the start; up to 2 m/s at its nozzle");
}
