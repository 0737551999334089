// Tests overrides (--set): they replace values of the file and go through the same checks.
#include "tests/catch.h"

#include "tests/scenes/scene_text.h"

using scenes_test::kBall;
using scenes_test::Lines;
using scenes_test::problemsOf;
using scenes_test::sceneOf;

TEST_CASE("overrides replace values of the file and add to it") {
    const std::string text = kBall + "[physics]\nstep = 0.1\n";
    CHECK(sceneOf(text).setup.step == 0.1);
    CHECK(sceneOf(text, {"physics.step=0.005"}).setup.step == 0.005);
    CHECK(sceneOf(text, {"physics.step=0.005", "physics.step=0.25"}).setup.step == 0.25);
    CHECK(sceneOf(kBall, {"physics.drag=2"}).setup.drag == 2.0);
    CHECK(sceneOf(kBall, {"fps=50"}).fps == render::FrameRate{50, 1});
    CHECK(sceneOf(kBall, {"fps=30000/1001"}).fps == render::FrameRate{30000, 1001});
}

TEST_CASE("a bare word is a string, other values are TOML") {
    CHECK(sceneOf(kBall, {"physics.stepper=symplectic-euler"}).setup.stepper == engine::StepperKind::symplecticEuler);
    CHECK(sceneOf(kBall, {"physics.stepper=\"symplectic-euler\""}).setup.stepper ==
          engine::StepperKind::symplecticEuler);
    CHECK(sceneOf(kBall, {"title=two words = three"}).title == "two words = three");
    CHECK(sceneOf(kBall, {"physics.gravity=[1, -2.5, 3]"}).setup.gravity == engine::Vec3(1.0, -2.5, 3.0));
    CHECK(sceneOf(kBall, {"look.shadows=false"}).look.common.light.shadows == false);
    CHECK(sceneOf(kBall, {"material.color=#ffffff"}).materialColors.at(0) == engine::Vec3(1.0, 1.0, 1.0));
}

TEST_CASE("tables of a list are counted from 0, with brackets or dots") {
    const std::string two = kBall + "[[body]]\nshape = \"ball\"\nradius = 0.1\n";
    CHECK(sceneOf(two, {"body[1].velocity=[9, 0, 0]"}).setup.initial.velocity.back() == engine::Vec3(9.0, 0.0, 0.0));
    CHECK(sceneOf(two, {"body.1.velocity=[9, 0, 0]"}).setup.initial.velocity.back() == engine::Vec3(9.0, 0.0, 0.0));
    CHECK(sceneOf(two, {"body.1.velocity=[9, 0, 0]"}).setup.initial.velocity.front() == engine::Vec3(0.0, 0.0, 0.0));
    CHECK(sceneOf(kBall + "[material]\nb1 = 1\n", {"material[0].b1=2"}).setup.materials.at(0).repulsion == 2.0);
}

TEST_CASE("problems of overrides name the option, after those of the file and in their order") {
    CHECK(problemsOf(kBall, {"physics.step=-1"}) ==
          Lines{"--set physics.step=-1: step is -1, must be >= 1e-09 (seconds)"});
    CHECK(problemsOf(kBall, {"physics.gravty=1"}) ==
          Lines{"--set physics.gravty=1: unknown key \"physics.gravty\", did you mean \"gravity\"?"});
    CHECK(problemsOf(kBall, {"phisics.step=1"}) ==
          Lines{"--set phisics.step=1: unknown table \"phisics\", did you mean \"physics\"?"});
    CHECK(problemsOf(kBall + "[physics]\ndrag = -1\n", {"physics.step=0", "fps=0"}) ==
          Lines{"pile.toml:7:8: drag is -1, must be >= 0 (per second)",
                "--set physics.step=0: step is 0, must be >= 1e-09 (seconds)",
                "--set fps=0: fps is 0, must be 1 to 240 (per second)"});
    CHECK(problemsOf(kBall, {"look.size=[640, 4.5]"}) ==
          Lines{"--set look.size=[640, 4.5]: size[1] is 4.5, must be a whole number (pixels)"});
    CHECK(problemsOf(kBall, {scenes::Override("look.size=[8, 64]", "--size 8x64"), "fps=0"}) ==
          Lines{"--size 8x64: size[0] is 8, must be 16 to 8192 (pixels)",
                "--set fps=0: fps is 0, must be 1 to 240 (per second)"});
}

TEST_CASE("an override replaces a wrong value of the file") {
    CHECK(problemsOf(kBall + "[physics]\nstep = -1\n").size() == 1);
    CHECK(problemsOf(kBall + "[physics]\nstep = -1\n", {"physics.step=1"}) == Lines{});
}

TEST_CASE("overrides of unknown keys are rejected") {
    const std::string form = "must be KEY=VALUE, with a key like fps, physics.step or body[0].radius";
    for (const std::string text : {"fps", "=3", "physics.=3", "body[0=3", "body]0[.radius=1", "a.b.c=3", "body[0]=3"})
        CHECK(problemsOf(kBall, {text}) == Lines{"--set " + text + ": " + form});
    CHECK(problemsOf(kBall, {"body[1].radius=1"}) ==
          Lines{"--set body[1].radius=1: the scene has only 1 [[body]], counted from 0"});
    CHECK(problemsOf(kBall, {"emitter[0].rate=1"}) == Lines{"--set emitter[0].rate=1: the scene has no [[emitter]]"});
    CHECK(problemsOf(kBall, {"body.radius=1"}) == Lines{"--set body.radius=1: body is a list, write body[0].radius"});
    CHECK(problemsOf(kBall, {"body[99999999999999999999].radius=1"}).size() == 1);
}

TEST_CASE("where an override changes the shape, keys of the former shape are ignored") {
    const std::string text = kBall + "[camera]\nprojection = \"orthographic\"\nhalf_height = 3\n";
    CHECK(problemsOf(text, {"camera.projection=perspective"}) == Lines{});
    CHECK(sceneOf(text, {"camera.projection=perspective"}).camera.at(0).placement.projection ==
          render::Projection::perspective);
    CHECK(problemsOf(text, {"camera.projection=perspective", "camera.half_height=2"}) ==
          Lines{"--set camera.half_height=2: half_height does not apply to projection \"perspective\", only to "
                "orthographic"});
}
