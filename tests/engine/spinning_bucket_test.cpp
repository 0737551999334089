// Liquid in a spinning bucket turns with it, and its surface is the paraboloid y = w^2 r^2 / 2g + c.
#include "tests/catch.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/run/advance.h"
#include "tests/engine/runs.h"

using namespace engine;

namespace {

constexpr double kRadius = 0.1;  // of a particle, m
constexpr double kInside = 1.1;  // radius of the inside of the bucket, m
constexpr double kGravity = 9.8;
constexpr double kTurns = 0.8;   // a second
constexpr double kShaken = 4.0;  // s
constexpr double kEnd = 5.0;     // s

double distanceFromAxis(const Vec3& position) {
    return std::hypot(position.x(), position.z());
}

/// Turns evenly and moves up and down less and less until kShaken. Particles without friction heap up at up to 6
/// degrees, as frictionless spheres do, until something shakes them.
Motion shakenTurning() {
    constexpr double kPeriod = 0.08;  // s, half of one
    Motion motion;
    for (int k = 0; k * kPeriod <= kEnd + 1.0; ++k) {
        const double time = k * kPeriod;
        const double height = k == 0 ? 0.0 : 0.08 * std::max(0.0, 1.0 - time / kShaken);
        motion.keys.push_back({time, Vec3(0, k % 2 == 0 ? -height : height, 0), Vec3(0, 360.0 * kTurns * time, 0)});
    }
    return motion;
}

Setup bucketOfLiquid() {
    Material liquid = withRadius(*materialPreset("liquid"), kRadius);
    liquid.repulsion = 0.9;  // 1 m of it sinks by a fifth under its own weight
    liquid.damping = 0.3;
    Setup setup = runs::freeSetup(liquid, StepperKind::velocityVerlet, 0.002);
    setup.gravity = Vec3(0, -kGravity, 0);
    Obstacles& obstacles = setup.obstacles;
    obstacles.wall = WallLaw::scaled;
    obstacles.gravity = kGravity;
    obstacles.shapes = {revolutionSolid(
        Revolution({{0.0, 0.0}, {kInside + 0.1, 0.0}, {kInside + 0.1, 4.0}}, false, 0.1), Vec3::Zero())};
    obstacles.surfaces = {{.friction = 0.5}};
    obstacles.motions = {shakenTurning()};
    for (const Vec3& position : gridPositions(Vec3(0, 0.95, 0), {11, 8, 11}, {.spacing = 0.2, .jitter = 0.2}))
        if (distanceFromAxis(position) < kInside - kRadius)
            append(setup.initial, {.position = position, .radius = kRadius, .mass = liquid.mass});
    return setup;
}

bool isInBucket(const Vec3& position) {
    return distanceFromAxis(position) < kInside;
}

/// Whether no particle stands higher near the vertical through this point.
bool isAtSurface(const Particles& particles, const Vec3& point) {
    return std::ranges::none_of(particles.position, [&](const Vec3& other) {
        return other.y() > point.y() + 0.5 * kRadius && distanceFromAxis(other - point) < 1.5 * kRadius;
    });
}

/// Angular momentum over moment of inertia of what is in the bucket, rad/s.
double meanSpin(const Particles& particles) {
    double angularMomentum = 0.0;
    double inertia = 0.0;
    for (std::size_t p = 0; p < particles.count(); ++p) {
        const Vec3& position = particles.position[p];
        if (!isInBucket(position)) continue;  // it was shaken out
        angularMomentum += position.cross(particles.velocity[p]).y();
        inertia += distanceFromAxis(position) * distanceFromAxis(position);
    }
    return angularMomentum / inertia;
}

/// The slope of a line through points (x, y) by least squares.
double fittedSlope(const std::vector<std::pair<double, double>>& points) {
    const auto count = static_cast<double>(points.size());
    double sumX = 0.0, sumY = 0.0, sumXX = 0.0, sumXY = 0.0;
    for (const auto& [x, y] : points) {
        sumX += x;
        sumY += y;
        sumXX += x * x;
        sumXY += x * y;
    }
    return (count * sumXY - sumX * sumY) / (count * sumXX - sumX * sumX);
}

}  // namespace

TEST_CASE("Liquid in a spinning bucket turns with it and stands as a paraboloid", "[motion][long]") {
    Simulation simulation = start(bucketOfLiquid());
    advance(simulation, kEnd);
    constexpr double kSpin = 2.0 * std::numbers::pi * kTurns;
    // Some hundred particles still swing by some hundredths of their speed.
    CHECK(meanSpin(simulation.particles) == Approx(kSpin).epsilon(0.005));

    std::vector<std::pair<double, double>>
        surface;  // squared distance from the axis and height, but for the wall's layer
    for (const Vec3& position : simulation.particles.position)
        if (distanceFromAxis(position) < kInside - 2.0 * kRadius && isAtSurface(simulation.particles, position))
            surface.emplace_back(distanceFromAxis(position) * distanceFromAxis(position), position.y());
    REQUIRE(surface.size() > 30);
    // The friction coefficient of frictionless spheres, 0.1, is 5 % of the surface's slope at its mean radius. Heights
    // scatter by half a radius, which is another 5 % of the slope with fifty particles over 1 m^2.
    CHECK(fittedSlope(surface) == Approx(kSpin * kSpin / (2.0 * kGravity)).epsilon(0.1));
}
