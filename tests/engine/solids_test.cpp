// Solids that are known by their distance, as obstacles: against closed forms, and shots of which none may pass.
#include "tests/catch.h"

#include <cmath>

#include "engine/core/random.h"
#include "engine/obstacles/obstacle_surfaces.h"
#include "engine/run/advance.h"
#include "engine/run/diagnostics.h"
#include "tests/engine/obstacles.h"
#include "tests/engine/runs.h"

using namespace engine;

namespace {

Obstacles scaled(const Obstacle& shape) {
    Obstacles obstacles = only(shape);
    obstacles.wall = WallLaw::scaled;
    return obstacles;
}

/// Distances are known up to more than a surface can act on a particle, m.
constexpr double kBand = 0.35;

/// A grid of the distances from a sphere of radius 1 m around the origin.
DistanceGrid sphereGrid(double voxel) {
    DistanceBricks bricks;
    bricks.voxel = voxel;
    bricks.band = static_cast<float>(kBand);
    const auto count = static_cast<std::uint32_t>(std::ceil(2.0 * (1.0 + kBand + voxel) / (kBrickVoxels * voxel)));
    bricks.counts = {count, count, count};
    bricks.origin = Vec3::Constant(-0.5 * count * kBrickVoxels * voxel);
    for (std::uint32_t brick = 0; brick < count * count * count; ++brick) {
        bricks.brickOf.push_back(brick);
        const Vec3 corner(brick % count, brick / count % count, brick / (count * count));
        for (int node = 0; node < kBrickNodes * kBrickNodes * kBrickNodes; ++node) {
            const Vec3 inBrick(node % kBrickNodes, node / kBrickNodes % kBrickNodes,
                               node / (kBrickNodes * kBrickNodes));
            const Vec3 point = bricks.origin + voxel * (kBrickVoxels * corner + inBrick);
            bricks.values.push_back(std::min(bricks.band, static_cast<float>(point.norm() - 1.0)));
        }
    }
    return DistanceGrid(std::move(bricks));
}

/// A ball of radius 1 m as a wall around a single point.
Revolution ball() {
    return Revolution({{0.0, 0.0}}, false, 1.0);
}

Setup shot(const Obstacles& obstacles, const Vec3& from, const Vec3& velocity, double mass) {
    Material material = *materialPreset("liquid");
    material.mass = mass;
    Setup setup = runs::freeSetup(material, StepperKind::velocityVerlet, 0.005);
    setup.obstacles = obstacles;
    append(setup.initial, {.position = from, .velocity = velocity, .radius = material.radius, .mass = mass});
    return setup;
}

double heightOver(const Obstacles& obstacles, const Vec3& point) {
    double height = kFar;
    forEachSurface(obstacles, point, 0.0, kFar,
                   [&](const Surface& surface) { height = std::min(height, surface.height); });
    return height;
}

/// Solids of all kinds, each within 1.5 m of the origin.
std::vector<Obstacle> solids() {
    const auto turned = [](const std::vector<ProfilePoint>& points, bool isClosed, double half) {
        return revolutionSolid(Revolution(points, isClosed, half), Vec3::Zero());
    };
    return {turned(cylinderProfile(0.8, 1.2), true, 0.0),
            turned(frustumProfile(1.0, 0.3, 1.5), true, 0.0),
            turned(frustumProfile(1.0, 0.0, 1.5), true, 0.0),
            turned(capsuleProfile(0.4, 2.0), false, 0.4),
            turned({{0.9, 0.0}}, false, 0.3),
            turned({{0.0, -0.8}, {0.7, -0.5}, {1.0, 0.6}}, false, 0.03),
            meshSolid(sphereGrid(0.075), Vec3::Zero())};
}

}  // namespace

TEST_CASE("A ball by its distances acts like a sphere", "[solids]") {
    const Obstacles sphere = scaled(Sphere{Vec3::Zero(), 1.0});
    const Obstacles turned = scaled(revolutionSolid(ball(), Vec3::Zero()));
    const Obstacles grid = scaled(meshSolid(sphereGrid(0.02), Vec3::Zero()));
    for (std::uint32_t k = 0; k < 50; ++k) {
        const Vec3 direction = randomVector(5, k).normalized();
        const Probe probe{(1.02 + 0.0025 * k) * direction, randomVector(6, k)};
        const ContactSums expected = sumContacts(sphere, probe);
        CHECK((sumContacts(turned, probe).force - expected.force).norm() < 1e-12 * (1.0 + expected.force.norm()));
        CHECK(sumContacts(turned, probe).energy == Approx(expected.energy).epsilon(1e-12).margin(1e-15));
        // Trilinear interpolation of a sphere errs by at most 3/8 of the square of the voxel over the radius.
        CHECK(heightOver(grid, probe.position) == Approx(heightOver(sphere, probe.position)).margin(3.0 / 8.0 * 4e-4));
        CHECK((sumContacts(grid, probe).force - expected.force).norm() < 0.03 * (1.0 + expected.force.norm()));
    }
}

TEST_CASE("The force of a distance grid is minus the gradient of its energy", "[solids]") {
    const Obstacles grid = scaled(meshSolid(sphereGrid(0.1), Vec3::Zero()));
    for (std::uint32_t k = 0; k < 50; ++k) {
        Probe probe{1.08 * randomVector(7, k).normalized(), Vec3::Zero()};
        const Vec3 force = sumContacts(grid, probe).force;
        constexpr double kShort = 1e-6;
        for (int axis = 0; axis < 3; ++axis) {
            Probe before = probe, after = probe;
            before.position[axis] -= kShort;
            after.position[axis] += kShort;
            const double slope = (sumContacts(grid, after).energy - sumContacts(grid, before).energy) / (2.0 * kShort);
            CHECK(force[axis] == Approx(-slope).epsilon(1e-4).margin(1e-4 * force.norm()));
        }
    }
}

TEST_CASE("Rebounds from a ball by its distances are those from a sphere", "[solids]") {
    for (const double speed : {1.0, 10.0, 100.0}) {
        std::vector<Vec3> velocities;
        for (const Obstacle& shape :
             {Obstacle(Sphere{Vec3::Zero(), 1.0}), Obstacle(revolutionSolid(ball(), Vec3::Zero())),
              Obstacle(meshSolid(sphereGrid(0.01), Vec3::Zero()))}) {
            Simulation simulation = start(shot(scaled(shape), Vec3(0.3, 2.0, 0.1), Vec3(0, -speed, 0), 1.0));
            advance(simulation, 2.0 / speed);
            velocities.push_back(simulation.particles.velocity[0]);
        }
        CAPTURE(speed, velocities[0].transpose(), velocities[1].transpose(), velocities[2].transpose());
        CHECK(velocities[0].y() > -0.9 * speed);
        CHECK((velocities[1] - velocities[0]).norm() < 1e-6 * speed);
        CHECK((velocities[2] - velocities[0]).norm() < 0.02 * speed);
    }
}

TEST_CASE("No shot passes a solid, at any speed and mass", "[solids]") {
    for (const Obstacle& shape : solids()) {
        const Obstacles obstacles = scaled(shape);
        for (std::uint32_t k = 0; k < 200; ++k) {
            const Vec3 from = 4.0 * randomVector(1, k).normalized();
            const Vec3 at = 0.7 * randomVector(2, k);
            const double speed = k % 3 == 0 ? 1.0 : k % 3 == 1 ? 30.0 : 1000.0;
            const double mass = k % 2 == 0 ? 1.0 : 1e6;
            Simulation simulation = start(shot(obstacles, from, speed * (at - from).normalized(), mass));
            const double before = energy(simulation).total();
            for (int frame = 1; frame <= 8; ++frame) {
                advance(simulation, frame / speed);
                const double height = heightOver(simulation.setup.obstacles, simulation.particles.position[0]);
                CAPTURE(shape.index(), k, speed, mass, frame);
                CHECK(height > -1e-6);
            }
            CHECK(energy(simulation).total() <= before * (1.0 + 1e-3));
        }
    }
}

TEST_CASE("A heavy pile does not leak out of a bowl", "[solids]") {
    Obstacles obstacles =
        scaled(revolutionSolid(Revolution({{0.0, 0.0}, {0.9, 0.15}, {1.2, 1.5}}, false, 0.05), Vec3::Zero()));
    obstacles.gravity = 9.8;
    Material material = *materialPreset("liquid");
    material.mass = 50.0;
    Setup setup = runs::freeSetup(material, StepperKind::velocityVerlet, 0.005);
    setup.gravity = Vec3(0, -9.8, 0);
    setup.obstacles = obstacles;
    for (const Vec3& position :
         boxPositions(Vec3(-0.6, 0.5, -0.6), Vec3(0.6, 1.3, 0.6), {.spacing = 0.25, .jitter = 0.05}))
        append(setup.initial,
               {.position = position, .velocity = Vec3(0, -3, 0), .radius = material.radius, .mass = material.mass});
    Simulation simulation = start(setup);
    for (int frame = 1; frame <= 30; ++frame) advance(simulation, frame / 30.0);
    CHECK(simulation.particles.count() > 50);
    for (const Vec3& position : simulation.particles.position) {
        const bool isOverRim = position.y() > 1.4 || std::hypot(position.x(), position.z()) > 1.25;
        CHECK(heightOver(obstacles, position) > -1e-6);
        // What lies lower than the rim is inside.
        if (!isOverRim) CHECK(position.y() > 0.04);
    }
}
