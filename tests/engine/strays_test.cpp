// Which particles count as having left the scene.
#include "engine/run/strays.h"

#include "tests/catch.h"

#include "tests/engine/runs.h"

using namespace engine;

TEST_CASE("A particle far outside has left the scene if it moves away and touches nothing", "[strays]") {
    Setup setup = runs::freeSetup(*materialPreset("liquid"), StepperKind::velocityVerlet, 0.01);
    setup.gravity = Vec3(0, -9.8, 0);
    setup.obstacles.shapes = {Box{Vec3(-1, -1, -1), Vec3(1, 1, 1)}};  // four times its diagonal is 13.9 m
    append(setup.initial, {.position = Vec3(0, 0.5, 0)});
    const auto strays = [&](const Vec3& position, const Vec3& velocity) {
        Simulation simulation = start(setup);
        append(simulation.particles, {.position = position, .velocity = velocity});
        return strayCount(simulation);
    };
    CHECK(strays(Vec3(0, -20, 0), Vec3(0, -5, 0)) == 1);
    CHECK(strays(Vec3(20, -20, 0), Vec3(3, 0, 0)) == 1);
    CHECK(strays(Vec3(0, -10, 0), Vec3(0, -5, 0)) == 0);  // near
    CHECK(strays(Vec3(20, 0, 0), Vec3(-3, 0, 0)) == 0);   // comes nearer
    CHECK(strays(Vec3(0, 20, 0), Vec3(0, 5, 0)) == 0);    // will fall back
    CHECK(strays(Vec3(0, -20, 0), Vec3::Zero()) == 0);    // at rest
    setup.obstacles.shapes.push_back(Plane{Vec3(0, -1, 0), Vec3::UnitY()});
    CHECK(strays(Vec3(20, -0.9, 0), Vec3(3, 0, 0)) == 0);  // rolls on the floor
    CHECK(strays(Vec3(20, -0.5, 0), Vec3(3, 0, 0)) == 1);
    setup.obstacles.shapes = {Plane{Vec3(0, -1, 0), Vec3::UnitY()}};
    setup.initial = {};
    CHECK(strays(Vec3(20, 10, 0), Vec3(3, 0, 0)) == 0);  // a scene without a place
    append(setup.initial, {.position = Vec3(0, 50, 0)});
    CHECK(strays(Vec3(0, 40, 0), Vec3(0, -5, 0)) == 0);  // falls to the floor
}
