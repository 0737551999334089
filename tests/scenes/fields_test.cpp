// Tests that [[field]] tables become the engine's fields, and their messages.
#include "tests/catch.h"

#include <limits>
#include <numbers>

#include "engine/state/fields.h"
#include "tests/scenes/scene_text.h"

using engine::Vec3;
using scenes_test::kBall;
using scenes_test::Lines;
using scenes_test::problemsOf;
using scenes_test::sceneOf;

namespace {

engine::Field fieldOf(const std::string& lines) {
    return sceneOf(kBall + "[[field]]\n" + lines).setup.fields.at(0);
}

}  // namespace

TEST_CASE("the keys of a field reach the engine") {
    const engine::Field uniform = fieldOf("kind = \"uniform\"\nacceleration = [1, 2, 3]\n");
    CHECK(std::get<engine::UniformField>(uniform.law).acceleration == Vec3(1, 2, 3));
    CHECK(!uniform.box);
    CHECK(uniform.start == 0.0);
    CHECK(uniform.until == std::numeric_limits<double>::infinity());
    CHECK(uniform.isConservative());
    const engine::Field point =
        fieldOf("kind = \"point\"\ncenter = [1, 2, 3]\nstrength = -4\nsoftening = 0.25\nstart = 0.5\nuntil = 1.5\n");
    CHECK(std::get<engine::PointField>(point.law).center == Vec3(1, 2, 3));
    CHECK(std::get<engine::PointField>(point.law).strength == -4.0);
    CHECK(std::get<engine::PointField>(point.law).softening == 0.25);
    CHECK(point.start == 0.5);
    CHECK(point.until == 1.5);
    CHECK(!point.isConservative());
    const engine::Field vortex = fieldOf("kind = \"vortex\"\ncenter = [1, 0, 0]\nspin = [0, 0.5, 0]\nrate = 3\n");
    CHECK(std::get<engine::FlowField>(vortex.law).spin == Vec3(0, std::numbers::pi, 0));
    CHECK(std::get<engine::FlowField>(vortex.law).center == Vec3(1, 0, 0));
    CHECK(std::get<engine::FlowField>(vortex.law).rate == 3.0);
    const engine::Field wind =
        fieldOf("kind = \"drag\"\nvelocity = [2, 0, 0]\nrate = 3\nminimum = [0, 0, 0]\nmaximum = [1, 2, 3]\n");
    CHECK(std::get<engine::FlowField>(wind.law).velocity == Vec3(2, 0, 0));
    REQUIRE(wind.box);
    CHECK(wind.box->low == Vec3(0, 0, 0));
    CHECK(wind.box->high == Vec3(1, 2, 3));
}

TEST_CASE("a field with one corner has no bound on the other side") {
    const engine::Field above = fieldOf("kind = \"drag\"\nrate = 3\nminimum = [-5, 1, -5]\n");
    REQUIRE(above.box);
    CHECK(above.box->low == Vec3(-5, 1, -5));
    CHECK(above.box->contains(Vec3(1e7, 1e7, 1e7)));
}

TEST_CASE("mistakes in fields are found") {
    const auto problems = [](const std::string& lines) { return problemsOf(kBall + "[[field]]\n" + lines); };
    CHECK(problems("acceleration = [1, 0, 0]\n") == Lines{"pile.toml:6:1: kind is missing, a field needs it"});
    CHECK(problems("kind = \"wind\"\n").size() == 1);
    CHECK(problems("kind = \"uniform\"\n") ==
          Lines{"pile.toml:6:1: acceleration is missing, a field of kind \"uniform\" needs it (m/s^2)"});
    CHECK(problems("kind = \"drag\"\nrate = -1\n") == Lines{"pile.toml:8:8: rate is -1, must be 0 to 1000000000 (per "
                                                            "second)"});
    CHECK(problems("kind = \"drag\"\nrate = 1\nstrenght = 1\n").size() == 1);
    CHECK(problems("kind = \"drag\"\nrate = 1\nminimum = [0, 0, 0]\nmaximum = [1, -1, 1]\n") ==
          Lines{"pile.toml:10:11: maximum[1] is -1, must be above the minimum 0 (meters)"});
    CHECK(problems("kind = \"drag\"\nrate = 1\nstart = 2\nuntil = 1\n") ==
          Lines{"pile.toml:10:9: until is 1, must be after start, 2 (seconds)"});
    CHECK(problems("kind = \"vortex\"\ncenter = [0, 0, 0]\nspin = [0, 0, 0]\nrate = 1\n") ==
          Lines{"pile.toml:9:8: spin is [0, 0, 0], must not be zero"});
}

TEST_CASE("fields can be overridden, and change the hash of the simulation") {
    const std::string text = kBall + "[[field]]\nkind = \"drag\"\nrate = 1\n";
    CHECK(std::get<engine::FlowField>(sceneOf(text, {"field[0].rate=2"}).setup.fields.at(0).law).rate == 2.0);
    CHECK(sceneOf(text, {"field[0].rate=2"}).simulationHash != sceneOf(text).simulationHash);
}
