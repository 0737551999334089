// Packings of bodies: counts, spacing, containment, jitter.
#include "engine/state/bodies.h"

#include <cmath>
#include "tests/catch.h"

using namespace engine;

namespace {

double nearestDistance(const std::vector<Vec3>& positions) {
    double nearest = 1e300;
    for (std::size_t p = 0; p < positions.size(); ++p)
        for (std::size_t i = p + 1; i < positions.size(); ++i)
            nearest = std::min(nearest, (positions[p] - positions[i]).norm());
    return nearest;
}

}  // namespace

TEST_CASE("A ball is filled with a face-centered cubic packing", "[bodies]") {
    const Vec3 center(1, 2, 3);
    const auto positions = ballPositions(center, 1.5, {.spacing = 0.3});
    for (const Vec3& position : positions) CHECK((position - center).norm() <= 1.5 + 1e-8);  // the slack of the surface
    CHECK(nearestDistance(positions) == Approx(0.3).epsilon(1e-12));  // rounding of coordinates of size 4
    // Volume of the ball over the volume spacing^3/sqrt(2) of a lattice point, to the roughness of the surface layer.
    const double expected = 4.0 / 3.0 * 3.14159265 * 1.5 * 1.5 * 1.5 / (0.027 / std::sqrt(2.0));
    CHECK(static_cast<double>(positions.size()) == Approx(expected).epsilon(0.1));
}

TEST_CASE("A box is filled up to its faces", "[bodies]") {
    const double edge = 0.3 * std::sqrt(2.0);  // edge of the lattice's cubic cell
    const auto positions = boxPositions(Vec3::Zero(), Vec3(2 * edge, 2 * edge, 2 * edge), {.spacing = 0.3});
    CHECK(positions.size() == 63);  // corners, edges and faces of 2 x 2 x 2 cubes around their center
    CHECK(nearestDistance(positions) == Approx(0.3).epsilon(1e-12));  // rounding
}

TEST_CASE("A grid has the counts asked for and is centered", "[bodies]") {
    const auto positions = gridPositions(Vec3(0, 1, 0), {4, 5, 1}, {.spacing = 0.5});
    CHECK(positions.size() == 20);
    Vec3 mean = Vec3::Zero();
    for (const Vec3& position : positions) mean += position / 20.0;
    CHECK((mean - Vec3(0, 1, 0)).norm() < 1e-14);                     // rounding of twenty terms
    CHECK(nearestDistance(positions) == Approx(0.5).epsilon(1e-14));  // rounding
}

TEST_CASE("Jitter is bounded, repeatable, seeded, and keeps a planar body planar", "[bodies]") {
    const Packing packing{.spacing = 0.5, .jitter = 0.2, .seed = 5};
    const auto still = gridPositions(Vec3::Zero(), {6, 6, 1}, {.spacing = 0.5});
    const auto moved = gridPositions(Vec3::Zero(), {6, 6, 1}, packing);
    double largest = 0.0;
    for (std::size_t p = 0; p < still.size(); ++p) {
        CHECK(moved[p].z() == 0.0);
        largest = std::max(largest, (moved[p] - still[p]).cwiseAbs().maxCoeff());
    }
    CHECK(largest <= 0.1);
    CHECK(largest > 0.05);
    CHECK(gridPositions(Vec3::Zero(), {6, 6, 1}, packing) == moved);
    CHECK(gridPositions(Vec3::Zero(), {6, 6, 1}, {.spacing = 0.5, .jitter = 0.2, .seed = 6}) != moved);
}
