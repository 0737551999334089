// Signed distances of solids of revolution against closed forms and against a plain search along the profile, and of
// grids against the functions that they hold.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "engine/shapes/distance_grid.h"
#include "engine/shapes/revolution.h"
#include "tests/catch.h"

namespace {

using engine::DistanceBricks;
using engine::DistanceGrid;
using engine::ProfilePoint;
using engine::Revolution;
using engine::SignedDistance;
using engine::Vec3;

/// Some sums and a square root of numbers below 10.
constexpr double kRounding = 1e-14;

std::vector<Vec3> pointsWithin(double limit, int count) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> coordinate(-limit, limit);
    std::vector<Vec3> points;
    for (int k = 0; k < count; ++k) {
        const double x = coordinate(random);
        const double y = coordinate(random);
        points.emplace_back(x, y, coordinate(random));
    }
    return points;
}

double radiusOf(const Vec3& point) {
    return std::hypot(point.x(), point.z());
}

/// Distance from a segment, straight from its definition.
double segmentDistance(const ProfilePoint& a, const ProfilePoint& b, double radius, double height) {
    const double dr = b.radius - a.radius;
    const double dh = b.height - a.height;
    const double lengthSq = dr * dr + dh * dh;
    const double share =
        lengthSq > 0.0 ? std::clamp(((radius - a.radius) * dr + (height - a.height) * dh) / lengthSq, 0.0, 1.0) : 0.0;
    return std::hypot(radius - a.radius - share * dr, height - a.height - share * dh);
}

/// Signed distance from a polygon: the nearest edge off the axis, and the winding number as a sum of angles.
double polygonDistance(const std::vector<ProfilePoint>& points, double radius, double height) {
    double distance = INFINITY;
    double angle = 0.0;
    for (std::size_t k = 0; k < points.size(); ++k) {
        const ProfilePoint& a = points[k];
        const ProfilePoint& b = points[(k + 1) % points.size()];
        if (a.radius > 0.0 || b.radius > 0.0) distance = std::min(distance, segmentDistance(a, b, radius, height));
        const double ar = a.radius - radius;
        const double ah = a.height - height;
        const double br = b.radius - radius;
        const double bh = b.height - height;
        angle += std::atan2(ar * bh - ah * br, ar * br + ah * bh);
    }
    return std::abs(angle) > std::numbers::pi ? -distance : distance;
}

/// Central difference of the value. Not for points near a medial axis.
template <class Shape>
Vec3 slopeOf(const Shape& shape, const Vec3& point, double step) {
    Vec3 slope;
    for (int axis = 0; axis < 3; ++axis) {
        const Vec3 offset = step * Vec3::Unit(axis);
        slope[axis] = (shape.at(point + offset).value - shape.at(point - offset).value) / (2.0 * step);
    }
    return slope;
}

double lengthOf(const Vec3& vector) {
    return std::sqrt(engine::squaredLength(vector));
}

/// A bowl with a foot: sharp, blunt, inner and straight corners, and two stretches on the axis.
std::vector<ProfilePoint> goblet() {
    return {{0.0, -1.0}, {0.7, -1.0}, {0.72, -0.9}, {0.1, -0.8}, {0.1, -0.4}, {0.1, 0.0},
            {0.8, 0.3},  {0.9, 1.2},  {0.8, 1.2},   {0.7, 0.4},  {0.0, 0.1}};
}

/// A rounded profile of many edges, of which some close in on themselves.
std::vector<ProfilePoint> flower() {
    std::vector<ProfilePoint> points;
    for (int k = 0; k < 150; ++k) {
        const double angle = 2.0 * std::numbers::pi * k / 150.0;
        const double reach = 0.6 + 0.25 * std::sin(5.0 * angle);
        points.push_back({1.0 + reach * std::cos(angle), reach * std::sin(angle)});
    }
    return points;
}

}  // namespace

TEST_CASE("A turned rectangle is a cylinder, a turned point a torus", "[shapes]") {
    const Revolution cylinder(engine::cylinderProfile(0.6, 1.4), true, 0.0);
    const Revolution torus({{0.9, 0.2}}, false, 0.3);
    const Revolution ball({{0.0, -0.1}}, false, 0.5);
    const Revolution capsule(engine::capsuleProfile(0.4, 2.0), false, 0.4);
    for (const Vec3& point : pointsWithin(2.0, 2000)) {
        const double radius = radiusOf(point);
        const double side = radius - 0.6;
        const double top = std::abs(point.y()) - 0.7;
        const double ofCylinder =
            std::min(std::max(side, top), 0.0) + std::hypot(std::max(side, 0.0), std::max(top, 0.0));
        CHECK(std::abs(cylinder.at(point).value - ofCylinder) <= kRounding);
        CHECK(std::abs(torus.at(point).value - (std::hypot(radius - 0.9, point.y() - 0.2) - 0.3)) <= kRounding);
        CHECK(std::abs(ball.at(point).value - (std::hypot(radius, point.y() + 0.1) - 0.5)) <= kRounding);
        const double beyond = std::max(std::abs(point.y()) - 0.6, 0.0);
        CHECK(std::abs(capsule.at(point).value - (std::hypot(radius, beyond) - 0.4)) <= kRounding);
    }
}

TEST_CASE("Profiles of any form have the distance of their nearest edge", "[shapes]") {
    const auto isReversed = GENERATE(false, true);
    for (std::vector<ProfilePoint> points :
         {goblet(), flower(), engine::frustumProfile(0.8, 0.0, 1.0), engine::frustumProfile(0.3, 0.9, 1.5)}) {
        if (isReversed) std::reverse(points.begin(), points.end());
        const Revolution solid(points, true, 0.0);
        const Revolution wall(points, false, 0.05);
        for (const Vec3& point : pointsWithin(2.0, 3000)) {
            const double radius = radiusOf(point);
            CHECK(std::abs(solid.at(point).value - polygonDistance(points, radius, point.y())) <= kRounding);
            double distance = INFINITY;
            for (std::size_t k = 0; k + 1 < points.size(); ++k)
                distance = std::min(distance, segmentDistance(points[k], points[k + 1], radius, point.y()));
            CHECK(std::abs(wall.at(point).value - (distance - 0.05)) <= kRounding);
        }
    }
}

TEST_CASE("A closed wall ends where it begins", "[shapes]") {
    const std::vector<ProfilePoint> square = {{0.5, 0.0}, {1.5, 0.0}, {1.5, 1.0}, {0.5, 1.0}};
    const Revolution ring(square, true, 0.1);
    CHECK(ring.at({0.5, 0.5, 0.0}).value == Approx(-0.1));  // within the edge that closes it
    CHECK(ring.at({0.0, 0.5, -1.0}).value == Approx(0.4));  // in the hollow
    CHECK(Revolution(square, false, 0.1).at({0.5, 0.5, 0.0}).value == Approx(0.4));
    // A cylinder with floor and ceiling has no wall along its axis.
    const Revolution can(engine::cylinderProfile(1.0, 2.0), true, 0.1);
    CHECK(can.at(Vec3::Zero()).value == Approx(0.9));
}

TEST_CASE("The gradient of a solid of revolution is that of its distance, and a unit vector everywhere", "[shapes]") {
    const Revolution shapes[] = {{goblet(), true, 0.0},      {goblet(), false, 0.05},
                                 {flower(), true, 0.0},      {engine::cylinderProfile(0.6, 1.4), true, 0.0},
                                 {{{0.9, 0.2}}, false, 0.3}, {engine::capsuleProfile(0.4, 2.0), false, 0.4}};
    for (const Revolution& shape : shapes) {
        int kinks = 0;
        for (const Vec3& point : pointsWithin(1.5, 2000)) {
            const SignedDistance distance = shape.at(point);
            CHECK(std::abs(lengthOf(distance.gradient) - 1.0) <= 4e-16 * 4);  // a few roundings
            // A step of 1e-6 rounds by 1e-16 / 1e-6 and bends by 1e-6 over the least radius, 1e-3.
            if (lengthOf(slopeOf(shape, point, 1e-6) - distance.gradient) > 1e-3) ++kinks;
            // The surface is where the gradient leads to, but for the wall within the inner side of a corner.
            if (distance.value < 0.0) continue;
            CHECK(std::abs(shape.at(point - distance.value * distance.gradient).value) <= 1e-14);
        }
        CHECK(kinks < 10);  // the share of points within a step of a medial axis is about 1e-5
    }
}

TEST_CASE("Gradients are defined on the axis, at corners and on medial axes", "[shapes]") {
    for (const bool isClosed : {true, false})
        for (const auto& points : {goblet(), engine::cylinderProfile(0.6, 1.4), engine::frustumProfile(0.8, 0.0, 1.0),
                                   engine::capsuleProfile(0.2, 1.0)}) {
            if (isClosed && points.size() < 3) continue;
            const Revolution shape(points, isClosed, isClosed ? 0.0 : 0.05);
            std::vector<Vec3> places;
            for (const ProfilePoint& point : points) {
                places.emplace_back(point.radius, point.height, 0.0);
                places.emplace_back(0.0, point.height, 0.0);
                places.emplace_back(0.0, point.height, -point.radius);
            }
            for (int k = -20; k <= 20; ++k) places.emplace_back(0.0, 0.1 * k, 0.0);
            for (const Vec3& place : places) {
                const SignedDistance distance = shape.at(place);
                INFO(place.transpose() << " gradient " << distance.gradient.transpose());
                CHECK(std::abs(lengthOf(distance.gradient) - 1.0) <= 1e-15);
                CHECK(std::isfinite(distance.value));
            }
        }
}

TEST_CASE("A sharp tip on the axis has an inside and an outside", "[shapes]") {
    const Revolution cone(engine::frustumProfile(0.5, 0.0, 1.0), true, 0.0);
    CHECK(cone.at({0.0, 0.7, 0.0}).value == Approx(0.2));
    CHECK(cone.at({0.0, 0.7, 0.0}).gradient.y() == 1.0);
    CHECK(cone.at({1e-9, 0.7, 0.0}).value == Approx(0.2));
    CHECK(cone.at({0.0, 0.4, 0.0}).value == Approx(-0.1 / std::sqrt(5.0)));
    // A dent: the tip is an inner corner.
    const Revolution dented({{0.0, -1.0}, {1.0, -1.0}, {1.0, 1.0}, {0.0, 0.0}}, true, 0.0);
    CHECK(dented.at({0.0, -0.2, 0.0}).value == Approx(-0.2));
    CHECK(dented.at({0.0, -0.2, 0.0}).gradient.y() == Approx(1.0));
    CHECK(dented.at({0.0, 0.2, 0.0}).value == Approx(0.2 / std::sqrt(2.0)));
}

TEST_CASE("The bounds of a solid of revolution hold it tightly", "[shapes]") {
    const Revolution shapes[] = {{goblet(), true, 0.0}, {goblet(), false, 0.05}, {flower(), true, 0.0}};
    for (const Revolution& shape : shapes) {
        const engine::BoundingBox box = shape.bounds();
        for (const Vec3& point : pointsWithin(2.0, 3000))
            if (!box.contains(point)) CHECK(shape.at(point).value > 0.0);
        for (const double height : {box.low.y(), box.high.y()}) {
            double least = INFINITY;
            for (double radius = 0.0; radius <= 2.0; radius += 1e-3)
                least = std::min(least, shape.at({radius, height, 0.0}).value);
            CHECK(std::abs(least) <= 1e-3);
        }
    }
}

TEST_CASE("A profile that is no shape is refused", "[shapes]") {
    CHECK_THROWS_AS(Revolution({}, true, 0.0), std::invalid_argument);
    CHECK_THROWS_AS(Revolution({{0.0, 0.0}, {1.0, 0.0}}, true, 0.0), std::invalid_argument);
    CHECK_THROWS_AS(Revolution({{0.0, 0.0}, {1.0, 0.0}, {2.0, 0.0}}, true, 0.0), std::invalid_argument);
    CHECK_THROWS_AS(Revolution({{0.0, 0.0}, {1.0, 0.0}}, false, 0.0), std::invalid_argument);
    CHECK_THROWS_AS(Revolution({{-0.1, 0.0}, {1.0, 0.0}}, false, 0.1), std::invalid_argument);
    CHECK_THROWS_AS(Revolution({{NAN, 0.0}, {1.0, 0.0}}, false, 0.1), std::invalid_argument);
}

namespace {

/// Bricks that hold a function, cut off at the band.
template <class Value>
DistanceBricks bricksOf(const Value& valueAt, std::uint32_t bricksPerAxis, double voxel, double band) {
    DistanceBricks bricks;
    bricks.voxel = voxel;
    bricks.band = static_cast<float>(band);
    bricks.counts = {bricksPerAxis, bricksPerAxis, bricksPerAxis};
    bricks.origin = Vec3::Constant(-0.5 * engine::kBrickVoxels * voxel * bricksPerAxis);
    for (std::uint32_t z = 0; z < bricksPerAxis; ++z)
        for (std::uint32_t y = 0; y < bricksPerAxis; ++y)
            for (std::uint32_t x = 0; x < bricksPerAxis; ++x) {
                std::vector<float> values;
                for (std::uint32_t k = 0; k < 9; ++k)
                    for (std::uint32_t j = 0; j < 9; ++j)
                        for (std::uint32_t i = 0; i < 9; ++i)
                            values.push_back(static_cast<float>(std::min(
                                valueAt(Vec3(bricks.origin + voxel * Vec3(8 * x + i, 8 * y + j, 8 * z + k))), band)));
                const bool isStored = std::ranges::any_of(values, [&](float value) { return value < bricks.band; });
                bricks.brickOf.push_back(isStored ? static_cast<std::uint32_t>(bricks.values.size() / 729)
                                                  : DistanceBricks::kNone);
                if (isStored) bricks.values.insert(bricks.values.end(), values.begin(), values.end());
            }
    return bricks;
}

double sphereDistance(const Vec3& point) {
    return std::sqrt(engine::squaredLength(point)) - 0.5;
}

}  // namespace

TEST_CASE("A grid gives back what is linear along each axis", "[shapes]") {
    const auto valueAt = [](const Vec3& point) { return (1.0 + point.x()) * (2.0 - point.y()) * (3.0 + point.z()); };
    const DistanceGrid grid(bricksOf(valueAt, 2, 0.125, 1000.0));
    for (const Vec3& point : pointsWithin(1.0, 2000)) {
        const SignedDistance distance = grid.at(point);
        CHECK(std::abs(distance.value - valueAt(point)) <= 24.0 * 0x1p-24);  // of floats of up to 24
        const Vec3 gradient((2.0 - point.y()) * (3.0 + point.z()), -(1.0 + point.x()) * (3.0 + point.z()),
                            (1.0 + point.x()) * (2.0 - point.y()));
        CHECK(lengthOf(distance.gradient - gradient) <= 2.0 * 24.0 * 0x1p-24 / 0.125 * 2.0);
    }
    CHECK(grid.at({1.0, 1.0, 1.0}).value == Approx(8.0));  // the last corner of the box
}

TEST_CASE("A grid is as near to a sphere as its voxels are small, and its gradient is exact", "[shapes]") {
    const double voxel = 0.04;
    const DistanceGrid grid(bricksOf(sphereDistance, 6, voxel, 3.0 * voxel));
    CHECK(grid.bricks().values.size() / 729 < 6 * 6 * 6);  // the corners are left out
    for (const Vec3& point : pointsWithin(0.95, 4000)) {
        const SignedDistance distance = grid.at(point);
        const double exact = sphereDistance(point);
        if (exact > -0.4 && exact < 2.0 * voxel) {  // linear between corners: 3 h^2 / 8 over the radius, here 0.1
            CHECK(std::abs(distance.value - exact) <= 3.0 / 8.0 * voxel * voxel / 0.1);
        }
        CHECK(distance.value <= exact + 3.0 / 8.0 * voxel * voxel / 0.1);
        // Within a voxel the value is a cubic: the central difference is exact but for floats' and doubles' rounding.
        const Vec3 inVoxel =
            ((point - grid.bounds().low) / voxel).unaryExpr([](double x) { return x - std::floor(x); });
        if (inVoxel.minCoeff() > 0.01 && inVoxel.maxCoeff() < 0.99)
            CHECK(lengthOf(slopeOf(grid, point, 1e-4) - distance.gradient) <= 1e-9);
    }
}

TEST_CASE("Outside its bricks a grid gives a lower bound of the distance, continuously", "[shapes]") {
    const double voxel = 0.04;
    const DistanceGrid grid(bricksOf(sphereDistance, 6, voxel, 3.0 * voxel));
    double last = grid.at({0.0, 0.0, 0.0}).value;
    for (double x = 0.0; x < 3.0; x += 1e-3) {
        const SignedDistance distance = grid.at({x, 0.3 * x, 0.2 * x});
        CHECK(std::abs(distance.value - last) <= 1.1e-3 * std::sqrt(3.0));  // of three slopes up to 1
        CHECK(distance.value <= sphereDistance({x, 0.3 * x, 0.2 * x}) + 1e-2);
        last = distance.value;
    }
    CHECK(grid.at({5.0, 0.0, 0.0}).value == Approx(3.0 * voxel + 5.0 - 0.96));
    CHECK(grid.at({5.0, 0.0, 0.0}).gradient == Vec3(1.0, 0.0, 0.0));
    CHECK(std::isnan(grid.at({NAN, 0.0, 0.0}).value));
}

TEST_CASE("A grid whose sizes do not fit is refused", "[shapes]") {
    DistanceBricks bricks = bricksOf(sphereDistance, 2, 0.1, 0.3);
    bricks.brickOf[3] = 8;
    CHECK_THROWS_AS(DistanceGrid(bricks), std::invalid_argument);
    bricks = bricksOf(sphereDistance, 2, 0.1, 0.3);
    bricks.values.pop_back();
    CHECK_THROWS_AS(DistanceGrid(bricks), std::invalid_argument);
    bricks = bricksOf(sphereDistance, 2, 0.1, 0.3);
    bricks.counts[0] = 3;
    CHECK_THROWS_AS(DistanceGrid(bricks), std::invalid_argument);
}
