// Straight motion among surfaces that no center passes.
#include "engine/obstacles/barriers.h"

#include <array>
#include <cmath>
#include <vector>
#include "tests/catch.h"

#include "engine/obstacles/obstacle_surfaces.h"
#include "engine/run/advance.h"
#include "engine/run/diagnostics.h"
#include "tests/engine/clouds.h"
#include "tests/engine/obstacles.h"
#include "tests/engine/runs.h"

using namespace engine;

namespace {

constexpr double kBallRadius = 0.1;

Obstacles all(std::vector<Obstacle> shapes, double friction = 0.0) {
    Obstacles obstacles;
    obstacles.shapes = std::move(shapes);
    obstacles.wall = WallLaw::scaled;
    obstacles.gravity = 9.8;
    obstacles.surfaces.assign(obstacles.shapes.size(), WallSurface{.rebound = reboundWith(0.6), .friction = friction});
    return obstacles;
}

/// Height of a point over the surface that it is furthest behind, m.
double heightOf(const Obstacles& obstacles, const Vec3& point) {
    double height = std::numeric_limits<double>::infinity();
    forEachSurface(obstacles, point, 0.0, kFar,
                   [&](const Surface& surface) { height = std::min(height, surface.height); });
    return height;
}

/// Five boxes that form a tumbler: a floor and four walls, which touch along their edges.
std::vector<Obstacle> tumbler(double thickness) {
    const double t = thickness;
    return {Box{Vec3(-1, -t, -1), Vec3(1, 0, 1)}, Box{Vec3(-1 - t, -t, -1), Vec3(-1, 2, 1)},
            Box{Vec3(1, -t, -1), Vec3(1 + t, 2, 1)}, Box{Vec3(-1, -t, -1 - t), Vec3(1, 2, -1)},
            Box{Vec3(-1, -t, 1), Vec3(1, 2, 1 + t)}};
}

}  // namespace

TEST_CASE("No motion ends inside an obstacle, and none gains energy", "[barriers]") {
    const std::vector<std::vector<Obstacle>> sets = {
        {Plane{Vec3(0, -1, 0), Vec3(0.6, 0.8, 0)}, Plane{Vec3(0, -1, 0), Vec3(-0.6, 0.8, 0)}},
        {Plane{Vec3(0, -1, 0), Vec3(0.96, 0.28, 0)}, Plane{Vec3(0, -1, 0), Vec3(-0.96, 0.28, 0)}},
        {Container{Vec3(-1, -1, -1), Vec3(1, 1, 1)}},
        {Sphere{Vec3(-0.6, -0.8, 0), 0.7}, Sphere{Vec3(0.6, -0.8, 0.1), 0.65}, Sphere{Vec3(0, -0.5, 1), 0.5}},
        {Box{Vec3(-1, -1, -1), Vec3(0, -0.5, 1)}, Box{Vec3(0, -1, -1), Vec3(1, -0.5, 1)},
         Box{Vec3(-1, -0.5, -1), Vec3(-0.5, 0.5, 1)}},
        tumbler(0.2),
        tumbler(0.001)};
    for (const std::vector<Obstacle>& set : sets)
        for (const double far : {0.0, 1e6})
            for (std::uint64_t number = 0; number < 200; ++number) {
                const Obstacles obstacles = all(set, number % 2 == 0 ? 0.0 : 0.4);
                const double speed = std::pow(10.0, static_cast<double>(number % 6) - 2.0);
                Probe particle{0.4 * clouds::randomVector(1, number) + Vec3(0, 0.6, 0),
                               speed * clouds::randomVector(2, number), kBallRadius};
                if (far > 0.0 || heightOf(obstacles, particle.position) < 0.0) continue;
                for (int call = 0; call < 30; ++call) {
                    const double before = squaredLength(particle.velocity);
                    moveAmongBarriers(obstacles, particle, 0.7 / speed,
                                      call % 3 == 0 ? Arrival::slides : Arrival::rebounds);
                    REQUIRE(heightOf(obstacles, particle.position) >= 0.0);
                    REQUIRE(squaredLength(particle.velocity) <= before * (1.0 + 1e-14));  // roundings of the answer
                    particle.velocity +=
                        0.3 * speed * clouds::randomVector(3 + number, static_cast<std::uint64_t>(call));
                }
            }
}

TEST_CASE("A particle slides over the seam of two boxes as over one", "[barriers]") {
    const Obstacles seam = all({Box{Vec3(-5, -1, -1), Vec3(0, 0, 1)}, Box{Vec3(0, -1, -1), Vec3(5, 0, 1)}});
    Probe particle{Vec3(-1, 0, 0), Vec3(2, -1, 0), kBallRadius};
    for (int step = 0; step < 100; ++step) {
        moveAmongBarriers(seam, particle, 0.01, Arrival::slides);
        particle.velocity.y() -= 0.1;
    }
    CHECK(particle.velocity.x() == 2.0);
    CHECK(particle.position.x() == Approx(1.0).epsilon(1e-12));  // a hundred roundings
    CHECK(particle.position.y() >= 0.0);
    CHECK(particle.position.y() < 1e-5 * kBallRadius);
}

TEST_CASE("A barrier reflects with the restitution and rubs with the friction of its surface", "[barriers]") {
    const Obstacles floor = all({Plane{}}, 0.25);
    Probe particle{Vec3(0, 1, 0), Vec3(3, -2, 0), kBallRadius};
    CHECK(moveAmongBarriers(floor, particle, 1.0, Arrival::rebounds) == 1);
    CHECK(particle.velocity.y() == Approx(1.2).epsilon(1e-12));
    CHECK(particle.velocity.x() == Approx(3.0 - 0.25 * 3.2).epsilon(1e-12));  // mu times the impulse along the normal
    CHECK(particle.position.y() == Approx(0.6).epsilon(1e-5));                // but for the skin
}

TEST_CASE("A particle that starts inside an obstacle is not held in it", "[barriers]") {
    const Obstacles box = all({Box{Vec3(-1, -1, -1), Vec3(1, 1, 1)}});
    Probe particle{Vec3(0, 0.5, 0), Vec3(0, 2, 0), kBallRadius};
    CHECK(moveAmongBarriers(box, particle, 1.0, Arrival::slides) == 0);
    CHECK(particle.position == Vec3(0, 2.5, 0));
}

TEST_CASE("A block of any mass stays above what it falls on, and comes to rest", "[barriers]") {
    for (const StepperKind stepper : {StepperKind::automatic, StepperKind::linearlyImplicit,
                                      StepperKind::velocityVerlet, StepperKind::symplecticEuler})
        for (const double mass : {1.0, 100.0, 1e4}) {
            Material material = *materialPreset("liquid");
            material.mass = mass;
            material.radius = 0.1;
            // The paper's own wall under such a block is passed by all of it.
            Setup setup = runs::freeSetup(material, stepper, 2e-3);
            setup.error = 0.05;
            setup.gravity = Vec3(0, -9.8, 0);
            setup.obstacles = all(tumbler(0.2));
            for (int k = 0; k < 64; ++k)
                append(setup.initial,
                       {.position = Vec3(0.2 * (k % 4) - 0.3, 1.0 + 0.2 * (k / 16), 0.2 * (k / 4 % 4) - 0.3),
                        .velocity = Vec3(0, -6, 0),
                        .radius = 0.1,
                        .mass = mass});
            Simulation simulation = start(setup);
            for (int frame = 1; frame <= 120; ++frame) advance(simulation, frame / 30.0);
            INFO(nameOf(stepper) << ", " << mass << " kg");
            CHECK(simulation.wallDepths.centersOutside == 0);
            CHECK(simulation.wallDepths.deepest <= 1.0);
            double fastest = 0.0;
            for (const Vec3& velocity : simulation.particles.velocity)
                fastest = std::max(fastest, std::abs(velocity.y()));
            CHECK(fastest < 0.01);  // across the floor, which has no friction, they still glide
        }
}

TEST_CASE("Two hundred random scenes keep every center outside of their obstacles", "[barriers]") {
    constexpr std::array kPresets = {"liquid", "solid", "powder", "honey", "sand"};
    std::size_t scenes = 0;
    for (std::uint64_t number = 0; scenes < 200; ++number) {
        const auto random = [&](std::uint64_t k) { return clouds::randomVector(1000 + number, k); };
        const double size = 0.5 + 0.4 * random(0).x();
        Obstacles obstacles = all({Container{Vec3(-3, -3, -3), Vec3(3, 3, 3)}}, 0.2 + 0.2 * random(0).y());
        for (std::uint64_t k = 0; k < 3; ++k) {
            const Vec3 half = (Vec3(1.05, 1.05, 1.05) + random(10 + k)) * size;
            obstacles.shapes.emplace_back(Box{2.5 * random(20 + k) - half, 2.5 * random(20 + k) + half});
            obstacles.shapes.emplace_back(Sphere{2.5 * random(30 + k), size * (1.1 + random(40 + k).x())});
        }
        Material material = *materialPreset(kPresets[number % kPresets.size()]);
        Setup setup = runs::freeSetup(material, StepperKind::automatic, 1e-3);
        setup.error = 1.0;
        setup.gravity = Vec3(0, -9.8, 0);
        setup.obstacles = obstacles;
        const double speed = std::pow(10.0, 1.25 * (1.0 + random(1).x()));  // 1 to 300 m/s
        const double mass = material.mass * std::pow(10.0, 2.0 * random(1).y());
        const Vec3 velocity = speed * random(2).normalized();
        bool isFree = true;
        for (const Vec3& position :
             gridPositions(2.5 * random(3), {3, 3, 3}, {.spacing = 2.0 * material.radius, .jitter = 0.05})) {
            isFree = isFree && heightOf(obstacles, position) > material.radius;
            append(setup.initial,
                   {.position = position, .velocity = velocity, .radius = material.radius, .mass = mass});
        }
        if (!isFree) continue;
        ++scenes;
        Simulation simulation = start(setup);
        for (int frame = 1; frame <= 6; ++frame) advance(simulation, frame / 60.0);
        INFO("scene " << number << ", " << material.name << " of " << mass << " kg at " << speed << " m/s");
        CHECK(simulation.wallDepths.centersOutside == 0);
    }
}
