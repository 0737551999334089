// The oracle's rays and shadows against closed forms and values worked by hand, so that render_tests may trust it; its
// metaballs and colors are tested in oracle_shading_test.cpp.
#include "studies/oracle/oracle.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "tests/catch.h"

#include "studies/oracle/polynomial.h"
#include "tests/render/oracle_near.h"

namespace {

using glm::dvec3;
using oracle::checkNear;
using oracle::Hit;
using oracle::kEps;
using oracle::Ray;

/// Coefficients of the product of (x - r) over four roots.
oracle::Quartic withRoots(const std::vector<double>& roots) {
    oracle::Quartic product{1.0};
    for (const double root : roots) {
        for (std::size_t power = 4; power > 0; --power) product[power] = product[power - 1] - root * product[power];
        product[0] *= -root;
    }
    return product;
}

}  // namespace

TEST_CASE("oracle: a polynomial said to stay negative does, and most that do are said to") {
    int said = 0;
    for (int k = 0; k < 2000; ++k) {
        oracle::Quartic c{};
        for (std::size_t power = 0; power < 5; ++power)
            c[power] = std::sin(12.9898 * k + 78.233 * double(power)) - (power == 0 ? 1.5 : 0.0);
        double largest = -10.0;
        for (int step = 0; step <= 400; ++step) largest = std::max(largest, oracle::valueAt(c, step / 200.0 - 1.0));
        INFO("polynomial " << k << ", largest " << largest);
        if (oracle::staysNegative(c)) REQUIRE(largest < 0.0);
        said += oracle::staysNegative(c) ? 1 : 0;
    }
    CHECK(said > 100);
    CHECK(oracle::staysNegative({-1.0, 0.0, 0.0, 0.0, 0.0}));
    CHECK_FALSE(oracle::staysNegative({-1.0, 1.0, 0.0, 0.0, 0.0}));  // 0 at 1
}

TEST_CASE("oracle: polynomial roots are those the polynomial was made from") {
    const std::vector<double> made{0.1, 0.2, 0.5, 0.9};
    const std::vector<double> found = oracle::rootsIn(withRoots(made), 0.0, 1.0);
    REQUIRE(found.size() == made.size());
    for (std::size_t i = 0; i < made.size(); ++i) {
        INFO("root " << i);
        checkNear(found[i], made[i], 4e-13);  // 8 roundings of sum |c| <= 1.1*1.2*1.5*1.9 = 3.8, over min |p'| = 0.021
    }
    CHECK(oracle::rootsIn(withRoots(made), 0.3, 0.8).size() == 1);
    CHECK(oracle::rootsIn({0.5, -1.0}, 0.0, 1.0) == std::vector<double>{0.5});
    CHECK(oracle::rootsIn({0.0, 1.0}, 0.0, 1.0) == std::vector<double>{0.0});
    CHECK(oracle::rootsIn({-1.0, 1.0}, 0.0, 1.0) == std::vector<double>{1.0});
    CHECK(oracle::rootsIn({1.0}, 0.0, 1.0).empty());
}

TEST_CASE("oracle: a double root is found once, and splits in two or none when shifted") {
    // (x - 1/2)^2 (x^2 + 1), exact in binary.
    CHECK(oracle::rootsIn({0.25, -1.0, 1.25, -1.0, 1.0}, 0.0, 1.0) == std::vector<double>{0.5});
    CHECK(oracle::rootsIn({0.0, 0.0, 1.0}, 0.0, 1.0) == std::vector<double>{0.0});
    CHECK(oracle::rootsIn({0.25 + 1e-12, -1.0, 1.25, -1.0, 1.0}, 0.0, 1.0).empty());
    const std::vector<double> pair = oracle::rootsIn({0.25 - 1e-12, -1.0, 1.0}, 0.0, 1.0);
    REQUIRE(pair.size() == 2);
    checkNear(pair[0], 0.5 - 1e-6, 4e-10);  // 4 roundings of values up to 1, over |p'| = 2e-6
    checkNear(pair[1], 0.5 + 1e-6, 4e-10);  // the same
}

TEST_CASE("oracle: perspective rays span the vertical field of view") {
    render::View view;
    view.camera.eye = {0.0F, 0.0F, 10.0F};
    const double slope = std::tan(0.5 * double(view.camera.verticalFov));
    const render::PictureSize size{200, 100};
    const dvec3 center = oracle::pixelRay(view, size, 100.0, 50.0).direction;
    checkNear(center, {0.0, 0.0, -1.0}, 4 * kEps);  // a few roundings of 1
    const dvec3 corner = oracle::pixelRay(view, size, 0.0, 0.0).direction;
    checkNear(corner / -corner.z, {-2.0 * slope, slope, -1.0}, 8 * kEps);  // values below 1: some eight operations
    view.camera.eye = {5.0F, 0.0F, 0.0F};  // looking along -x with y up, the right hand is at -z
    const dvec3 rightEdge = oracle::pixelRay(view, size, 200.0, 50.0).direction;
    checkNear(rightEdge / -rightEdge.x, {-1.0, 0.0, -2.0 * slope}, 8 * kEps);  // as above
    view.camera.up = {1.0F, 0.0F, 0.0F};
    CHECK_THROWS_AS(oracle::pixelRay(view, size, 0.0, 0.0), std::domain_error);
    view.camera.eye = view.camera.target;
    CHECK_THROWS_AS(oracle::pixelRay(view, size, 0.0, 0.0), std::domain_error);
}

TEST_CASE("oracle: orthographic rays are parallel and start on the eye's plane") {
    render::View view;
    view.camera.projection = render::Projection::orthographic;
    view.camera.eye = {0.0F, 0.0F, 10.0F};
    view.camera.halfHeight = 2.0F;
    view.particles = {{{-3.5F, 1.5F, 0.0F}, 1.0F, {1.0F, 0.0F, 0.0F}}};
    const Ray ray = oracle::pixelRay(view, {8, 4}, 0.5, 0.5);  // one pixel is one meter: the sphere's center
    checkNear(ray.origin, {-3.5, 1.5, 10.0}, 16 * kEps);       // a few roundings of values up to 10
    checkNear(ray.direction, {0.0, 0.0, -1.0}, 4 * kEps);      // a few roundings of 1
    const Hit hit = oracle::trace(view, ray);
    CHECK(hit.kind == Hit::Kind::particle);
    checkNear(hit.distance, 9.0, 32 * kEps);  // a few roundings of values up to 10
    CHECK(oracle::trace(view, oracle::pixelRay(view, {8, 4}, 4.0, 2.0)).kind == Hit::Kind::none);
}

TEST_CASE("oracle: a sphere is hit in front, from inside at once, and never from behind") {
    render::View view;
    view.particles = {{{0.0F, 0.0F, 0.0F}, 1.0F, {0.25F, 0.5F, 0.75F}}};
    const Hit hit = oracle::trace(view, {{0.6, 0.0, 10.0}, {0.0, 0.0, -1.0}});
    CHECK(hit.kind == Hit::Kind::particle);
    checkNear(hit.distance, 9.2, 32 * kEps);            // a few roundings of 10; 0.6, 0.8, 1 is a right triangle
    checkNear(hit.normal, {0.6, 0.0, 0.8}, 64 * kEps);  // the distance's error over the radius 1
    checkNear(hit.albedo, {0.25, 0.5, 0.75}, 0.0);      // exact in float
    const Hit inside = oracle::trace(view, {{0.0, 0.5, 0.0}, {0.0, 0.0, -1.0}});
    CHECK(inside.distance == 0.0);
    checkNear(inside.normal, {0.0, 1.0, 0.0}, 0.0);  // 0.5/0.5 is exact
    CHECK(oracle::trace(view, {{0.0, 0.0, -2.0}, {0.0, 0.0, -1.0}}).kind == Hit::Kind::none);
    CHECK(oracle::trace({}, {}).kind == Hit::Kind::none);
}

TEST_CASE("oracle: an off-axis silhouette is the tangent cone") {
    render::View view;
    view.camera.verticalFov = 1.2F;
    view.camera.eye = {0.0F, 0.0F, 5.0F};
    view.particles = {{{2.5F, 1.25F, 0.0F}, 1.0F, {}}};
    const render::PictureSize size{96, 64};
    const oracle::Picture picture = oracle::draw(view, size, 1);
    const dvec3 toCenter{2.5, 1.25, -5.0};
    const double tangentLength = std::sqrt(glm::dot(toCenter, toCenter) - 1.0);  // the cone's cosine times |toCenter|
    int coveredCount = 0;
    for (int i = 0; i < size.width * size.height; ++i) {
        const Ray ray = oracle::pixelRay(view, size, i % size.width + 0.5, i / size.width + 0.5);
        const double excess = glm::dot(ray.direction, toCenter) - tangentLength;
        INFO("pixel " << i << ", excess " << excess);
        REQUIRE(std::abs(excess) > 1e-9);  // no pixel so near the edge that rounding (1e-15) could decide
        REQUIRE((picture.kinds[std::size_t(i)] == Hit::Kind::particle) == (excess > 0.0));
        coveredCount += excess > 0.0 ? 1 : 0;
    }
    CHECK(coveredCount > 100);
}

TEST_CASE("oracle: box faces, corners and parallel rays") {
    render::View view;
    view.boxObstacles = {{{-1.0F, -2.0F, -3.0F}, {1.0F, 2.0F, 3.0F}, {}}};
    for (int axis = 0; axis < 3; ++axis) {
        for (const double side : {-1.0, 1.0}) {
            Ray ray{dvec3{0.25}, dvec3{0.0}};
            ray.origin[axis] = 10.0 * side;
            ray.direction[axis] = -side;
            const Hit hit = oracle::trace(view, ray);
            CAPTURE(axis, side);
            CHECK(hit.kind == Hit::Kind::boxObstacle);
            CHECK(hit.distance == 9.0 - axis);
            dvec3 expected{0.0};
            expected[axis] = side;
            checkNear(hit.normal, expected, 0.0);  // set, not computed
            ray.origin[(axis + 1) % 3] = 3.5;      // beside the box: the largest half side is 3
            CHECK(oracle::trace(view, ray).kind == Hit::Kind::none);
        }
    }
    // Along (-3, -4, 0)/5 toward the corner edge (1, 2): 0.1 m to either side of it the ray enters by +x, or by +y.
    const dvec3 direction{-0.6, -0.8, 0.0};
    const Hit viaX = oracle::trace(view, {dvec3{1.0, 1.9, 0.0} - 5.0 * direction, direction});
    const Hit viaY = oracle::trace(view, {dvec3{0.9, 2.0, 0.0} - 5.0 * direction, direction});
    checkNear(viaX.normal, {1.0, 0.0, 0.0}, 0.0);                        // set, not computed
    checkNear(viaY.normal, {0.0, 1.0, 0.0}, 0.0);                        // set, not computed
    checkNear(viaX.distance, 5.0, 32 * kEps);                            // a few roundings of 6, over the slope 0.6
    checkNear(viaY.distance, 5.0, 32 * kEps);                            // the same, over 0.8
    const Ray past{dvec3{-1.0, 2.1, 0.0} - 5.0 * direction, direction};  // leaves the slab of x above the slab of y
    CHECK(oracle::trace(view, past).kind == Hit::Kind::none);
    const Hit inside = oracle::trace(view, {{0.0, 1.75, 0.0}, {0.0, 0.0, -1.0}});
    CHECK(inside.distance == 0.0);
    checkNear(inside.normal, {0.0, 1.0, 0.0}, 0.0);  // the nearest face
}

TEST_CASE("oracle: the ground lies behind what stands on it and ends at the horizon") {
    render::View view;
    view.ground = render::Ground{};
    view.ground->height = -1.0F;
    view.sphereObstacles = {{{6.0F, 0.0F, 0.0F}, 0.5F, {}}};
    const Ray down{{0.0, 3.0, 0.0}, {0.6, -0.8, 0.0}};
    const Hit hit = oracle::trace(view, down);
    CHECK(hit.kind == Hit::Kind::ground);
    checkNear(hit.distance, 5.0, 8 * kEps);             // 4/0.8: one rounding each of 0.8 and the quotient 5
    checkNear(hit.point, {3.0, -1.0, 0.0}, 16 * kEps);  // the same, times a slope below 1
    checkNear(hit.normal, {0.0, 1.0, 0.0}, 0.0);        // set, not computed
    CHECK(oracle::trace(view, {down.origin, {0.6, 0.8, 0.0}}).kind == Hit::Kind::none);
    CHECK(oracle::trace(view, {down.origin, {0.0, 0.0, -1.0}}).kind == Hit::Kind::none);
    view.sphereObstacles[0].center = {1.5F, 1.0F, 0.0F};
    CHECK(oracle::trace(view, down).kind == Hit::Kind::sphereObstacle);
    checkNear(oracle::trace(view, down).distance, 2.0, 8 * kEps);  // 2.5 to the center, less the radius
}

TEST_CASE("oracle: the shadow of a ball on the ground is the analytic ellipse, for every kind of ball") {
    // Light from (0.6, 0.8, 0): the shadow of a ball of radius r at height y is centered at x - y 0.6/0.8 and has the
    // half axes r/0.8 along x and r along z.
    render::View view;
    view.ground = render::Ground{};
    view.light.toLight = {0.6F, 0.8F, 0.0F};
    const int kind = GENERATE(0, 1, 2);
    CAPTURE(kind);
    const float radius = 0.5F;
    if (kind == 2) view.sphereObstacles = {{{0.0F, 2.0F, 0.0F}, radius, {}}};
    if (kind != 2) view.particles = {{{0.0F, 2.0F, 0.0F}, radius, {}}};
    view.style = kind == 1 ? render::Style::metaballs : render::Style::spheres;
    int shadowedCount = 0;
    for (int i = 0; i < 60 * 60; ++i) {
        const dvec3 point{-3.0 + 0.0501 * (i % 60), 0.0, -1.5 + 0.0501 * (i / 60)};
        const double along = (point.x + 1.5) / (0.5 / 0.8);
        const double excess = 1.0 - along * along - point.z * point.z / 0.25;
        INFO("point " << point.x << ", " << point.z << ", excess " << excess);
        REQUIRE(std::abs(excess) > 1e-6);  // not so near that 0.6 and 0.8 in float (1e-7) or the lift (1e-9) decide
        REQUIRE(oracle::isInShadow(oracle::Scene(view), point, {0.0, 1.0, 0.0}) == (excess > 0.0));
        shadowedCount += excess > 0.0 ? 1 : 0;
    }
    CHECK(shadowedCount > 300);  // the area pi 0.5 0.625 over 0.0501^2 is 391 points
}

TEST_CASE("oracle: a convex body hides the light from its far side only, and the ground hides nothing") {
    render::View view;
    view.ground = render::Ground{};
    view.light.toLight = {0.0F, 1.0F, 0.0F};
    view.style = GENERATE(render::Style::spheres, render::Style::metaballs);
    view.particles = {{{0.0F, -5.0F, 0.0F}, 1.0F, {}}};
    for (int i = 1; i < 180; ++i) {
        if (i == 90) continue;  // the terminator itself
        const double angle = i * 3.14159265358979 / 180.0;
        const dvec3 normal{std::sin(angle), std::cos(angle), 0.0};
        CAPTURE(i);
        CHECK(oracle::isInShadow(oracle::Scene(view), dvec3{0.0, -5.0, 0.0} + normal, normal) == (i > 90));
    }
    view.boxObstacles = {{{-1.0F, -3.0F, -1.0F}, {1.0F, -2.0F, 1.0F}, {}}};
    CHECK(oracle::isInShadow(oracle::Scene(view), {0.0, -4.0, 0.0}, {0.0, 1.0, 0.0}));
}
