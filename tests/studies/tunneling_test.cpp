// Which shots count as having passed an obstacle: first and last places by hand, every shape.
#include "studies/stability/observables.h"
#include "tests/catch.h"
#include "tests/studies/handmade_runs.h"

using engine::Vec3;
using studies_test::frameOf;
using studies_test::runOf;
using studies_test::sceneWith;

namespace {

/// Shots that passed an obstacle on a flight from one place to another.
double passes(const std::string& obstacle, const Vec3& from, const Vec3& to) {
    const studies::Run run = runOf({frameOf({{from}}), frameOf({{to}})});
    return studies::tunnelingCount({sceneWith("[[obstacle]]\n" + obstacle), run});
}

}  // namespace

TEST_CASE("a plane is passed behind its repulsor, half a meter deep") {
    CHECK(passes("shape = \"plane\"\n", {0, 1, 0}, {0, 3, 0}) == 0.0);
    CHECK(passes("shape = \"plane\"\n", {0, 1, 0}, {0, -0.4, 0}) == 0.0);
    CHECK(passes("shape = \"plane\"\n", {0, 1, 0}, {0, -0.6, 0}) == 1.0);
}

TEST_CASE("a container is passed beyond its walls") {
    const std::string container = "shape = \"container\"\nminimum = [-1, -1, -1]\nmaximum = [1, 1, 1]\n";
    CHECK(passes(container, {0, 0, 0}, {0.9, 0.9, -0.9}) == 0.0);
    CHECK(passes(container, {0, 0, 0}, {0, 1.6, 0}) == 1.0);
    CHECK(passes(container, {0, 0, 0}, {0, 0, -1.6}) == 1.0);
}

TEST_CASE("a box is passed by a way through it, however thin, or an end inside") {
    const std::string plate = "shape = \"box\"\nminimum = [-1, -0.01, -1]\nmaximum = [1, 0.01, 1]\n";
    CHECK(passes(plate, {0, 1, 0}, {0.5, 2, 0}) == 0.0);
    CHECK(passes(plate, {0, 1, 0}, {0, -100, 0}) == 1.0);
    CHECK(passes(plate, {0, 1, 0}, {5, -3, 0}) == 0.0);  // meets its plane at x = 1.25, beside it
    const std::string cube = "shape = \"box\"\nminimum = [-1, -1, -1]\nmaximum = [1, 1, 1]\n";
    CHECK(passes(cube, {0, 2, 0}, {0, 0.5, 0}) == 1.0);
    CHECK(passes(cube, {0, 0.5, 0}, {0, 0.2, 0}) == 1.0);
    CHECK(passes(cube, {0, 0.5, 0}, {0, 3, 0}) == 0.0);  // born inside, let out
}

TEST_CASE("a sphere is passed by a way through it or an end inside") {
    const std::string sphere = "shape = \"sphere\"\ncenter = [0, 0, 0]\nradius = 0.1\n";
    CHECK(passes(sphere, {0, 1, 0}, {0, 2, 0}) == 0.0);
    CHECK(passes(sphere, {0, 1, 0}, {0, -50, 0}) == 1.0);
    CHECK(passes(sphere, {0, 1, 0}, {3, -1, 0}) == 0.0);
    CHECK(passes(sphere, {0, 1, 0}, {0.05, 0, 0}) == 1.0);
    CHECK(passes(sphere, {0, 0.05, 0}, {0, 3, 0}) == 0.0);
}
