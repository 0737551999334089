// Obstacles near a point, found by a tree of bounding boxes, against a look at all of them.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>
#include "tests/catch.h"

#include "engine/obstacles/barriers.h"
#include "engine/obstacles/obstacle_surfaces.h"
#include "engine/obstacles/swept_contact.h"
#include "engine/run/advance.h"
#include "tests/engine/clouds.h"
#include "tests/engine/obstacles.h"
#include "tests/engine/runs.h"

using namespace engine;

namespace {

/// Random boxes within 5 m of the origin, every fourth of them alike, every third without extent.
std::vector<BoundingBox> randomBoxes(std::size_t count) {
    std::vector<BoundingBox> boxes;
    for (std::size_t k = 0; k < count; ++k) {
        if (k % 4 == 1) {
            boxes.push_back(boxes.back());
            continue;
        }
        const Vec3 middle = 5.0 * clouds::randomVector(11, k);
        const Vec3 half = k % 3 == 0 ? Vec3::Zero() : Vec3(0.4 * clouds::randomVector(12, k).cwiseAbs());
        boxes.push_back({middle - half, middle + half});
    }
    return boxes;
}

/// A plane, a container and 300 boxes and spheres, with their index.
Obstacles manyObstacles() {
    Obstacles obstacles;
    obstacles.wall = WallLaw::scaled;
    obstacles.gravity = 9.8;
    obstacles.shapes = {Plane{Vec3(0, -4, 0), Vec3::UnitY()}, Container{Vec3(-5, -5, -5), Vec3(5, 5, 5)}};
    for (std::uint64_t k = 0; k < 300; ++k) {
        const Vec3 middle = 4.5 * clouds::randomVector(21, k);
        const Vec3 half = Vec3(0.05, 0.05, 0.05) + Vec3(0.4 * clouds::randomVector(22, k).cwiseAbs());
        if (k % 2 == 0)
            obstacles.shapes.emplace_back(Box{middle - half, middle + half});
        else
            obstacles.shapes.emplace_back(Sphere{middle, half.x()});
    }
    for (std::size_t k = 0; k < obstacles.shapes.size(); ++k)
        obstacles.surfaces.push_back({.rebound = reboundWith(0.5), .adhesion = k % 5 == 0 ? 10.0 : 0.0});
    obstacles.index = indexOf(obstacles);
    return obstacles;
}

Obstacles withoutIndex(Obstacles obstacles) {
    obstacles.index = {};
    return obstacles;
}

Probe randomProbe(std::uint64_t number) {
    Probe probe;
    probe.position = 5.5 * clouds::randomVector(31, number);
    probe.velocity = 10.0 * clouds::randomVector(32, number);
    probe.radius = number % 10 == 0 ? 0.8 : 0.1;
    probe.friction = 0.3;
    return probe;
}

/// The heights of the surfaces that touch a particle, in ascending order.
std::vector<double> touchedHeights(const Obstacles& obstacles, const Probe& probe) {
    std::vector<double> heights;
    forEachTouched(obstacles, probe.position, 0.0, probe.radius,
                   [&](const Surface& surface) { heights.push_back(surface.height); });
    std::ranges::sort(heights);
    return heights;
}

}  // namespace

TEST_CASE("A tree of boxes finds each box that is near a point once", "[obstacle-index]") {
    CHECK(BoundingBoxTree(std::vector<BoundingBox>{}).isEmpty());
    for (const std::size_t count : {1U, 2U, 3U, 17U, 400U}) {
        const std::vector<BoundingBox> boxes = randomBoxes(count);
        const BoundingBoxTree tree(boxes);
        std::size_t foundCount = 0;
        for (std::uint64_t number = 0; number < 500; ++number) {
            const Vec3 point = 6.0 * clouds::randomVector(13, number);
            const double reach = std::pow(10.0, clouds::randomVector(14, number).x());  // 0.1 to 10 m
            std::vector<std::uint32_t> found, expected;
            tree.visitNear(point, reach, [&](std::uint32_t box) { found.push_back(box); });
            for (std::uint32_t box = 0; box < count; ++box) {
                const Vec3 nearest = point.cwiseMax(boxes[box].low).cwiseMin(boxes[box].high);
                if ((point - nearest).norm() < reach) expected.push_back(box);
            }
            std::ranges::sort(found);
            CHECK(found == expected);
            foundCount += found.size();
        }
        CHECK(foundCount > 0);
        CHECK(foundCount < 500 * count);
    }
}

TEST_CASE("Few obstacles have no index, many have one of all", "[obstacle-index]") {
    const Obstacles many = manyObstacles();
    Obstacles few = many;
    few.shapes.resize(5);
    CHECK(indexOf(few).solids.isEmpty());
    Obstacles ofPaper = many;
    ofPaper.wall = WallLaw::paper;
    CHECK(indexOf(ofPaper).solids.isEmpty());
    CHECK(many.index.unbounded == std::vector<std::uint32_t>{0, 1});
    CHECK(many.index.obstacleOf.size() == 300);
    Setup setup;
    setup.obstacles.shapes = many.shapes;
    setup.obstacles.wall = WallLaw::scaled;
    CHECK_FALSE(start(setup).setup.obstacles.index.solids.isEmpty());
}

TEST_CASE("Contacts and motion among many obstacles are those without the index", "[obstacle-index]") {
    const Obstacles many = manyObstacles();
    const Obstacles all = withoutIndex(many);
    std::size_t touched = 0, swept = 0, held = 0;
    for (std::uint64_t number = 0; number < 3000; ++number) {
        const Probe probe = randomProbe(number);
        INFO("particle " << number);
        const std::vector<double> heights = touchedHeights(all, probe);
        CHECK(touchedHeights(many, probe) == heights);
        touched += heights.size();
        // Only the order of the sums differs.
        const ContactSums sums = sumContacts(many, probe);
        const ContactSums expected = sumContacts(all, probe);
        CHECK((sums.force - expected.force).norm() <= 1e-12 * expected.force.norm());
        CHECK(std::abs(sums.energy - expected.energy) <= 1e-12 * std::abs(expected.energy));
        for (const double duration : {0.0, 0.001, 0.1}) {
            const Contacts contacts = contactsInStep(many, probe, duration, true);
            const Contacts exact = contactsInStep(all, probe, duration, true);
            CHECK(contacts.needsSweep == exact.needsSweep);
            CHECK((contacts.force - exact.force).norm() <= 1e-12 * exact.force.norm());
            CHECK(contacts.gap <= exact.gap);
            const double path = duration * probe.velocity.norm();
            CHECK(contacts.gap >= std::min(exact.gap, std::max(path, 5.0 * probe.radius)));
            swept += exact.needsSweep ? 1 : 0;
        }
        Probe moved = probe;
        Probe reference = probe;
        const int hits = moveAmongBarriers(many, moved, 0.1, Arrival::rebounds);
        CHECK(hits == moveAmongBarriers(all, reference, 0.1, Arrival::rebounds));
        CHECK(moved.position == reference.position);
        CHECK(moved.velocity == reference.velocity);
        held += static_cast<std::size_t>(hits);
    }
    CHECK(touched > 500);
    CHECK(swept > 500);
    CHECK(held > 500);
}

TEST_CASE("A swept contact among many obstacles is that without the index", "[obstacle-index]") {
    const Obstacles many = manyObstacles();
    const Obstacles all = withoutIndex(many);
    std::size_t compared = 0;
    for (std::uint64_t number = 0; number < 1000; ++number) {
        Probe moved = randomProbe(number);
        if (!touchedHeights(all, moved).empty()) continue;
        Probe reference = moved;
        // Short, so that a particle meets few obstacles: each multiplies the difference between two ways.
        advanceThroughContacts(many, moved, 0.03);
        advanceThroughContacts(all, reference, 0.03);
        INFO("particle " << number);
        CHECK((moved.position - reference.position).norm() <= 0.01 * moved.radius);
        ++compared;
    }
    CHECK(compared > 300);
}

TEST_CASE("Particles that fall among many boxes stay outside of them", "[obstacle-index]") {
    Setup setup = runs::freeSetup(*materialPreset("liquid"), StepperKind::automatic, 1e-3);
    setup.error = 1.0;
    setup.gravity = Vec3(0, -9.8, 0);
    setup.obstacles.wall = WallLaw::scaled;
    setup.obstacles.gravity = 9.8;
    setup.obstacles.shapes = {Container{Vec3(-5.5, -5, -5.5), Vec3(5.5, 20, 5.5)}};
    for (int k = 0; k < 100; ++k) {
        const Vec3 corner(1.1 * (k % 10) - 5.5, 0.0, 1.1 * (k / 10) - 5.5);  // NOLINT(bugprone-integer-division)
        setup.obstacles.shapes.emplace_back(Box{corner, corner + Vec3(1.1, 0.1 + 0.2 * (k * 7 % 5), 1.1)});
    }
    for (const Vec3& position : gridPositions(Vec3(0, 3, 0), {8, 4, 8}, {.spacing = 0.3, .jitter = 0.05}))
        append(setup.initial, {.position = position, .velocity = Vec3(3, -8, 1)});
    Simulation simulation = start(setup);
    CHECK_FALSE(simulation.setup.obstacles.index.solids.isEmpty());
    for (int frame = 1; frame <= 60; ++frame) advance(simulation, frame / 30.0);
    CHECK(simulation.wallDepths.centersOutside == 0);
    CHECK(simulation.wallDepths.deepest > 0.0);
    double lowest = 10.0;
    for (const Vec3& position : simulation.particles.position) lowest = std::min(lowest, position.y());
    CHECK(lowest > 0.1);
}
