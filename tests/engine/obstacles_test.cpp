// The obstacles of section 3.2 against contacts worked by hand.
#include "engine/obstacles/obstacles.h"

#include <cmath>
#include <vector>
#include "tests/catch.h"

#include "engine/force_law/pair_law.h"
#include "engine/obstacles/obstacle_surfaces.h"
#include "tests/engine/obstacles.h"
#include "tests/engine/rounding.h"

using namespace engine;

namespace {

Vec3 forceAt(const Obstacles& obstacles, const Vec3& position, const Vec3& velocity = Vec3::Zero()) {
    return sumContacts(obstacles, {position, velocity, 0.15, 2.0}).force;
}

double energyAt(const Obstacles& obstacles, const Vec3& position) {
    return sumContacts(obstacles, {position, Vec3::Zero(), 0.15, 2.0}).energy;
}

/// Force of a repulsor of radius rho at distance D, b1 = 10, c_r = 1.
double repulsion(double d, double rho) {
    const double rest = 0.15 + rho;
    return 10.0 * std::pow(1.0 / (d * d) - 1.0 / (rest * rest), 2);
}

}  // namespace

TEST_CASE("Contact with a plane starts at the particle's radius", "[obstacles]") {
    const Obstacles floor = only(Plane{});
    CHECK(forceAt(floor, Vec3(3, 0.15, -2)) == Vec3::Zero());
    CHECK(forceAt(floor, Vec3(3, 0.1501, -2)) == Vec3::Zero());
    CHECK(forceAt(floor, Vec3(3, 0.1499, -2)).y() > 0.0);
    const Vec3 force = forceAt(floor, Vec3(3, 0.05, -2));
    CHECK(force.y() == Approx(repulsion(0.55, 0.5)).epsilon(32 * kEps));  // a dozen roundings, some cancellation
    CHECK(force.x() == 0.0);
    CHECK(force.z() == 0.0);
}

TEST_CASE("A plane pushes out however deep a particle is", "[obstacles]") {
    const Obstacles floor = only(Plane{Vec3(0, 1, 0), Vec3(0, -1, 0)});
    const double core = 0.25 * 0.65;
    for (const double depth : {0.3, 0.5, 2.0, 100.0}) {
        const Vec3 force = forceAt(floor, Vec3(0, 1.0 + depth, 0));
        const double distance = std::max(0.5 - depth, core);
        CHECK(force.y() ==
              Approx(-repulsion(distance, 0.5)).epsilon(64 * kEps));  // a dozen roundings, some cancellation
    }
}

TEST_CASE("A contact damps with 5 c_d and only along the normal", "[obstacles]") {
    const Obstacles floor = only(Plane{});
    const Vec3 still = forceAt(floor, Vec3(0, 0.1, 0));
    const Vec3 falling = forceAt(floor, Vec3(0, 0.1, 0), Vec3(3, -2, 1));
    const double sd = 1.0 - 0.36 / (0.65 * 0.65);  // D = 0.6
    CHECK((falling - still).y() ==
          Approx(2.0 * 5.0 * 2.0 * sd).epsilon(1e3 * kEps));  // difference of 60 times larger sums
    CHECK(falling.x() == 0.0);
    CHECK(falling.z() == 0.0);
}

TEST_CASE("A container pushes inwards from each of its faces", "[obstacles]") {
    const Obstacles box = only(Container{Vec3(-1, -2, -3), Vec3(1, 2, 3)});
    CHECK(forceAt(box, Vec3::Zero()) == Vec3::Zero());
    for (int axis = 0; axis < 3; ++axis)
        for (const double side : {-1.0, 1.0}) {
            Vec3 position = Vec3::Zero();
            position[axis] = side * (axis + 0.95);
            const Vec3 force = forceAt(box, position);
            CHECK(force[axis] * side < 0.0);
            CHECK(squaredLength(force) == force[axis] * force[axis]);
        }
    const Vec3 corner = forceAt(box, Vec3(0.95, -1.95, 2.95));
    CHECK(corner.x() == Approx(-repulsion(0.55, 0.5)).epsilon(1e3 * kEps));  // 0.05 m off by the rounding of 1 - 0.95
    CHECK(corner.y() == Approx(repulsion(0.55, 0.5)).epsilon(1e3 * kEps));   // same
}

TEST_CASE("A solid box repels by signed distance", "[obstacles]") {
    const Obstacles box = only(Box{Vec3(-1, -1, -1), Vec3(1, 1, 1)});
    CHECK(forceAt(box, Vec3(0, 1.2, 0)) == Vec3::Zero());
    const Vec3 onTop = forceAt(box, Vec3(0.3, 1.1, 0.2));
    CHECK(onTop.y() == Approx(repulsion(0.6, 0.5)).epsilon(1e3 * kEps));  // 0.1 m off by the rounding of 1.1 - 1
    CHECK(onTop.x() == 0.0);
    const Vec3 edge = forceAt(box, Vec3(1.05, 1.05, 0));  // away from the edge, at 0.05 sqrt(2)
    CHECK(edge.x() == Approx(edge.y()).epsilon(64 * kEps));
    CHECK(edge.norm() == Approx(repulsion(0.5 + 0.05 * std::sqrt(2.0), 0.5)).epsilon(1e4 * kEps));  // same rounding
    CHECK(forceAt(box, Vec3(1.11, 1.11, 0)) == Vec3::Zero());  // 0.156 from the edge
    const Vec3 inside = forceAt(box, Vec3(0.2, 0.1, -0.9));    // nearest face is z = -1
    CHECK(inside.z() < 0.0);
    CHECK(inside.x() == 0.0);
    CHECK(forceAt(box, Vec3::Zero()).allFinite());
}

TEST_CASE("A sphere repels from under its surface, or literally with its own radius", "[obstacles]") {
    const Obstacles surface = only(Sphere{Vec3(1, 0, 0), 2.0, false});
    const Obstacles literal = only(Sphere{Vec3(1, 0, 0), 2.0, true});
    CHECK(forceAt(surface, Vec3(3.16, 0, 0)) == Vec3::Zero());
    CHECK(forceAt(surface, Vec3(3.1, 0, 0)).x() ==
          Approx(repulsion(0.6, 0.5)).epsilon(1e3 * kEps));  // rounding of 2.1 - 2
    CHECK(forceAt(literal, Vec3(3.1, 0, 0)).x() == Approx(repulsion(2.1, 2.0)).epsilon(1e4 * kEps));  // same, softer
    CHECK(forceAt(surface, Vec3(1, 0, 0)).y() > 0.0);  // at the very center: some finite force
    const Obstacles published = only(Sphere{Vec3::Zero(), 0.5, true});
    const Obstacles same = only(Sphere{Vec3::Zero(), 0.5, false});
    CHECK(forceAt(published, Vec3(0.3, 0.4, 0.1)) ==
          forceAt(same, Vec3(0.3, 0.4, 0.1)));  // at R = 0.5 m both are the same
}

TEST_CASE("Contact forces are minus the gradient of the contact energy", "[obstacles]") {
    const std::vector<Obstacle> all = {Plane{}, Container{Vec3(-1, -1, -1), Vec3(1, 1, 1)},
                                       Box{Vec3(-1, -1, -1), Vec3(0, 0, 0)}, Sphere{Vec3(0, -0.5, 0), 0.5, false}};
    const std::vector<Vec3> points = {
        {0.2, 0.06, 0.1}, {0.92, 0.93, -0.3}, {-0.3, -0.07, -0.4}, {0.06, 0.05, 0.08}, {0.1, -0.7, 0.2}};
    for (const Obstacle& obstacle : all)
        for (const Vec3& point : points) {
            const Obstacles obstacles = only(obstacle);
            const Vec3 force = forceAt(obstacles, point);
            for (int axis = 0; axis < 3; ++axis) {
                const double h = 1e-6;
                Vec3 step = Vec3::Zero();
                step[axis] = h;
                const double slope = (energyAt(obstacles, point + step) - energyAt(obstacles, point - step)) / (2 * h);
                // Rounding eps U/h and truncation h^2 F''/6 with U < 700 J and F'' < 1e6 N/m^2 above the core.
                CHECK(std::abs(force[axis] + slope) <= 700 * 4 * kEps / h + 1e6 * h * h + 1e-9 * force.norm());
            }
        }
}

TEST_CASE("What a particle touches is every surface below its radius, to the last bit", "[obstacles]") {
    const Vec3 center(0.3, -1.7, 2.9);
    const double radius = 0.15;
    Obstacles obstacles = only(Sphere{center, 1.1});
    obstacles.shapes.push_back(Box{Vec3(-1, -2, -3), Vec3(1, 2, 3)});
    obstacles.shapes.push_back(Plane{});
    obstacles.shapes.push_back(Container{Vec3(-2, -3, -4), Vec3(2, 3, 4)});
    std::size_t touched = 0, untouched = 0;
    const auto compare = [&](const Vec3& point) {
        std::vector<double> near, visited;
        forEachSurface(obstacles, point, 0.0, kFar, [&](const Surface& surface) {
            if (surface.height < radius) near.push_back(surface.height);
        });
        forEachTouched(obstacles, point, 0.0, radius,
                       [&](const Surface& surface) { visited.push_back(surface.height); });
        CHECK(visited == near);
        touched += near.size();
        untouched += 9 - near.size();
    };
    // Points around the sphere and around a face, an edge and a corner of the box: at the distance of contact, some
    // roundings to either side of it, well inside and far away.
    for (const Vec3& way : {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(1, 1, 0), Vec3(-1, 2, 3), Vec3(2, 3, -7)})
        for (const double away : {0.0, 0.1, 1.25, 5.0, 1e6})
            for (const double roundings : {-64.0, -3.0, -1.0, 0.0, 1.0, 3.0, 64.0})
                compare(center + away * (1.0 + roundings * kEps) * way.normalized());
    for (const Vec3& way : {Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(1, 1, 1)})
        for (const double roundings : {-64.0, -3.0, -1.0, 0.0, 1.0, 3.0, 64.0})
            compare(Vec3(1, 2, 3).cwiseProduct(way) + radius * (1.0 + roundings * kEps) * way.normalized());
    CHECK(touched > 100);
    CHECK(untouched > 100);
}
