// Which particles count as having tunneled through an obstacle: first and last positions by hand, for every shape.
#include "studies/stability/observables.h"
#include "tests/catch.h"
#include "tests/studies/handmade_runs.h"

using engine::Vec3;
using studies_test::frameOf;
using studies_test::runOf;
using studies_test::sceneWith;

namespace {

/// Number of particles that tunneled through an obstacle on a straight path from one position to another.
double tunneled(const std::string& obstacle, const Vec3& from, const Vec3& to) {
    const studies::Run run = runOf({frameOf({{from}}), frameOf({{to}})});
    return studies::tunnelingCount({sceneWith("[[obstacle]]\n" + obstacle), run});
}

}  // namespace

TEST_CASE("a particle is through a plane behind its repulsor, half a meter deep") {
    CHECK(tunneled("shape = \"plane\"\n", {0, 1, 0}, {0, 3, 0}) == 0.0);
    CHECK(tunneled("shape = \"plane\"\n", {0, 1, 0}, {0, -0.4, 0}) == 0.0);
    CHECK(tunneled("shape = \"plane\"\n", {0, 1, 0}, {0, -0.6, 0}) == 1.0);
}

TEST_CASE("a particle is through a container beyond its walls") {
    const std::string container = "shape = \"container\"\nminimum = [-1, -1, -1]\nmaximum = [1, 1, 1]\n";
    CHECK(tunneled(container, {0, 0, 0}, {0.9, 0.9, -0.9}) == 0.0);
    CHECK(tunneled(container, {0, 0, 0}, {0, 1.6, 0}) == 1.0);
    CHECK(tunneled(container, {0, 0, 0}, {0, 0, -1.6}) == 1.0);
}

TEST_CASE("a particle is through a box if its path crosses the box, however thin, or ends inside") {
    const std::string plate = "shape = \"box\"\nminimum = [-1, -0.01, -1]\nmaximum = [1, 0.01, 1]\n";
    CHECK(tunneled(plate, {0, 1, 0}, {0.5, 2, 0}) == 0.0);
    CHECK(tunneled(plate, {0, 1, 0}, {0, -100, 0}) == 1.0);
    CHECK(tunneled(plate, {0, 1, 0}, {5, -3, 0}) == 0.0);  // crosses the plane of the plate at x = 1.25, beside it
    const std::string cube = "shape = \"box\"\nminimum = [-1, -1, -1]\nmaximum = [1, 1, 1]\n";
    CHECK(tunneled(cube, {0, 2, 0}, {0, 0.5, 0}) == 1.0);
    CHECK(tunneled(cube, {0, 0.5, 0}, {0, 0.2, 0}) == 1.0);
    CHECK(tunneled(cube, {0, 0.5, 0}, {0, 3, 0}) == 0.0);  // born inside, and out again
}

TEST_CASE("a particle is through a sphere if its path crosses the sphere or ends inside") {
    const std::string sphere = "shape = \"sphere\"\ncenter = [0, 0, 0]\nradius = 0.1\n";
    CHECK(tunneled(sphere, {0, 1, 0}, {0, 2, 0}) == 0.0);
    CHECK(tunneled(sphere, {0, 1, 0}, {0, -50, 0}) == 1.0);
    CHECK(tunneled(sphere, {0, 1, 0}, {3, -1, 0}) == 0.0);
    CHECK(tunneled(sphere, {0, 1, 0}, {0.05, 0, 0}) == 1.0);
    CHECK(tunneled(sphere, {0, 0.05, 0}, {0, 3, 0}) == 0.0);
}
