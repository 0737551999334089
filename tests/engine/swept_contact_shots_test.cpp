// Shots of 0.01 to 1 kg at 1 to 1000 m/s at every kind of obstacle: none may pass. The far side is found by distances
// that this file computes itself.
#include "engine/obstacles/swept_contact.h"

#include <array>
#include <functional>
#include <limits>
#include "tests/catch.h"

#include "engine/obstacles/obstacle_surfaces.h"
#include "tests/engine/clouds.h"
#include "tests/engine/obstacles.h"

using namespace engine;

namespace {

constexpr std::array kMasses = {0.01, 0.1, 1.0};                              // kg
constexpr std::array kSpeeds = {1.0, 5.0, 20.0, 60.0, 100.0, 300.0, 1000.0};  // m/s

using Verdict = std::function<bool(const Vec3& before, const Vec3& now)>;

/// An obstacle that is shot at, and the shots.
struct Target {
    Obstacle obstacle;
    Vec3 aim;        ///< m
    Vec3 outward;    ///< the middle of the directions that shots come from
    double cone;     ///< least cosine between a shot and the way in
    Verdict passed;  ///< judges two successive positions of the particle, m
};

/// A direction within the target's cone.
Vec3 directionOf(const Target& target, std::uint64_t number) {
    for (std::uint64_t attempt = 0;; ++attempt) {
        const Vec3 direction = clouds::randomVector(31 + number, attempt).normalized();
        if (dot(direction, target.outward) < -target.cone) return direction;
    }
}

/// Distance of a point from the obstacle, negative inside, m.
double heightOver(const Obstacles& obstacles, const Vec3& point) {
    double height = std::numeric_limits<double>::infinity();
    forEachSurface(obstacles, point, 0.0, kFar,
                   [&](const Surface& surface) { height = std::min(height, surface.height); });
    return height;
}

/// Moves the particle 4 m from 1.5 m before the aim, in calls that cover `stride` meters at the initial speed.
void shoot(const Target& target, WallLaw wall, const Vec3& direction, double stride) {
    Obstacles obstacles;
    obstacles.shapes = {target.obstacle};
    obstacles.wall = wall;
    for (const double mass : kMasses)
        for (const double speed : kSpeeds) {
            Probe flight = withMass({target.aim - 1.5 * direction, speed * direction, 0.15, 2.0}, mass);
            bool passed = false;
            for (double way = 0.0; way < 4.0 && !passed; way += stride) {
                const Vec3 before = flight.position;
                advanceThroughContacts(obstacles, flight, stride / speed);
                passed = target.passed(before, flight.position) ||
                         (wall == WallLaw::scaled && heightOver(obstacles, flight.position) < 0.0);
            }
            INFO(mass << " kg at " << speed << " m/s along " << direction.transpose() << " is at "
                      << flight.position.transpose());
            CHECK_FALSE(passed);
        }
}

void shootFromAllSides(const Target& target, std::uint64_t directions) {
    for (std::uint64_t number = 0; number < directions; ++number)
        for (const WallLaw wall : {WallLaw::paper, WallLaw::scaled}) {
            shoot(target, wall, directionOf(target, number), 0.02);
            shoot(target, wall, directionOf(target, number), 4.0);
        }
}

/// Passed means: further than `depth` (m) under a face, or not finite.
Verdict deeperThan(double depth, const Vec3& point, const Vec3& normal) {
    return [=](const Vec3&, const Vec3& now) { return !(dot(now - point, normal) > -depth); };
}

/// Passed means: through the middle plane y = 0 of a plate of 2 m by 2 m, its rim of this width (m) apart.
Verdict throughPlate(double rim) {
    return [=](const Vec3& before, const Vec3& now) {
        if (!now.allFinite()) return true;
        if ((before.y() > 0.0) == (now.y() > 0.0)) return false;
        const Vec3 at = before + before.y() / (before.y() - now.y()) * (now - before);
        return std::max(std::abs(at.x()), std::abs(at.z())) < 1.0 - rim;
    };
}

/// Passed means: deeper than `depth` (m) inside a cube of 2 m about the origin.
Verdict deepInCube(double depth) {
    return [=](const Vec3&, const Vec3& now) { return !(now.cwiseAbs().maxCoeff() > 1.0 - depth); };
}

Box plate() {
    return {Vec3(-1, -0.01, -1), Vec3(1, 0.01, 1)};
}

Box cube() {
    return {Vec3(-1, -1, -1), Vec3(1, 1, 1)};
}

}  // namespace

TEST_CASE("No shot passes a plane", "[swept-contact]") {
    const Vec3 normal = Vec3(1, 2, -0.5).normalized();
    const Vec3 point(1, 1, 1);
    shootFromAllSides({Plane{point, normal}, point, normal, 0.1, deeperThan(0.5, point, normal)}, 24);
}

TEST_CASE("No shot passes a thick box", "[swept-contact]") {
    for (int axis = 0; axis < 3; ++axis)
        for (const double side : {-1.0, 1.0}) {
            const Vec3 normal = side * Vec3::Unit(axis);
            shootFromAllSides({cube(), normal, normal, 0.9, deeperThan(0.5, normal, normal)}, 2);
            shootFromAllSides({cube(), normal, normal, 0.1, deepInCube(0.5)}, 4);
        }
}

TEST_CASE("No shot passes a plate of 2 cm", "[swept-contact]") {
    const Vec3 up = Vec3::UnitY();
    shootFromAllSides({plate(), Vec3(0, 0.01, 0), up, 0.85, deeperThan(0.01, Vec3(0, 0.01, 0), up)}, 12);
    shootFromAllSides({plate(), Vec3(0.2, -0.01, 0.1), -up, 0.85, deeperThan(0.01, Vec3(0, -0.01, 0), -up)}, 12);
}

TEST_CASE("No shot at an edge or a corner passes through a box", "[swept-contact]") {
    for (const Vec3& out : {Vec3(1, 1, 0), Vec3(0, -1, 1), Vec3(1, 1, 1), Vec3(-1, 1, -1)})
        shootFromAllSides({cube(), out, out.normalized(), 0.2, deepInCube(0.5)}, 6);
}

TEST_CASE("No shot at the rim or a corner passes through a plate", "[swept-contact]") {
    for (const Vec3& out : {Vec3(1, 1, 0), Vec3(0, -1, 1), Vec3(1, 1, 1), Vec3(-1, -1, -1), Vec3(1, 0, 0)}) {
        const Target target{plate(), out.cwiseProduct(Vec3(1, 0.01, 1)), out.normalized(), 0.2, throughPlate(0.02)};
        for (std::uint64_t number = 0; number < 6; ++number)
            for (const WallLaw wall : {WallLaw::paper, WallLaw::scaled})
                shoot(target, wall, directionOf(target, number), 0.02);
    }
}

TEST_CASE("No shot at a sphere's middle passes it", "[swept-contact]") {
    for (const double radius : {0.5, 0.05})
        for (const Vec3& out : {Vec3(1, 0, 0), Vec3(0, -1, 0), Vec3(-1, 2, 0.5)}) {
            const Vec3 outward = out.normalized();
            const Vec3 center(0.3, 0.2, 0.1);
            shootFromAllSides({Sphere{center, radius, false}, center, outward, 0.7,
                               deeperThan(radius, center + radius * outward, outward)},
                              6);
        }
}

TEST_CASE("A particle that goes on nearly straight past a sphere has only grazed it", "[swept-contact]") {
    for (const double radius : {0.05, 0.5, 3.0}) {
        Obstacles obstacles;
        obstacles.shapes = {Sphere{Vec3::Zero(), radius, false}};
        const double graze = 0.2 * std::min(radius, 0.15);  // twice the barrier's depth, for the step that meets it
        for (const double mass : kMasses)
            for (const double speed : kSpeeds)
                for (int k = 0; k < 50; ++k) {
                    const double beside = radius * (k + 0.5) / 50;
                    Probe flight = withMass({Vec3(-radius - 0.5, beside, 0), Vec3(speed, 0, 0), 0.15, 2.0}, mass);
                    double least = radius;
                    for (double way = 0.0; way < 4.0 * radius + 4.0; way += 0.02) {
                        advanceThroughContacts(obstacles, flight, 0.02 / speed);
                        least = std::min(least, flight.position.norm());
                    }
                    INFO(mass << " kg at " << speed << " m/s, " << beside << " m beside the middle of a sphere of "
                              << radius << " m came to " << least << " m, leaves along "
                              << flight.velocity.transpose());
                    CHECK(flight.position.norm() > radius);
                    const bool straight = flight.velocity.x() > 0.9 * speed;
                    CHECK((!straight || radius - least < graze));
                }
    }
}

TEST_CASE("No shot leaves a container", "[swept-contact]") {
    Obstacles obstacles;
    obstacles.shapes = {Container{Vec3(-1, -1, -1), Vec3(1, 1, 1)}};
    for (std::uint64_t number = 0; number < 20; ++number)
        for (const double mass : kMasses)
            for (const double speed : kSpeeds) {
                Probe flight = withMass({0.8 * clouds::randomVector(41, number),
                                         speed * clouds::randomVector(42, number).normalized(), 0.15, 2.0},
                                        mass);
                double far = 0.0;
                for (int call = 0; call < 20; ++call) {
                    advanceThroughContacts(obstacles, flight, 0.5 / speed);
                    far = std::max(far, flight.position.cwiseAbs().maxCoeff());
                }
                INFO(mass << " kg at " << speed << " m/s is at " << flight.position.transpose());
                CHECK(flight.position.allFinite());
                CHECK(far < 1.5);  // walls at 1 m, a repulsor's radius
            }
}
