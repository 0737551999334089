// Obstacles in motion: poses, rebounds from walls that move, work, what a change of the frame of reference must not
// change, and particles that nothing fast may pass.
#include "engine/obstacles/motion.h"

#include "tests/catch.h"

#include "engine/core/hash.h"
#include "engine/obstacles/obstacle_surfaces.h"
#include "engine/run/advance.h"
#include "engine/run/checkpoint.h"
#include "engine/run/diagnostics.h"
#include "engine/stepping/step_cache.h"
#include "tests/engine/obstacles.h"
#include "tests/engine/runs.h"

using namespace engine;

namespace {

Motion gliding(const Vec3& velocity) {
    Motion motion;
    motion.velocity = velocity;
    return motion;
}

Motion turning(const Vec3& spin, const Vec3& pivot = Vec3::Zero()) {
    Motion motion;
    motion.spin = spin;
    motion.pivot = pivot;
    return motion;
}

/// A path of the pivot and of all three angles.
Motion winding() {
    Motion motion;
    motion.pivot = Vec3(0.5, 0.25, -0.125);
    motion.keys = {{0.0, Vec3(0, 0, 0), Vec3(0, 0, 0)},
                   {0.5, Vec3(1, 2, 0), Vec3(57, -29, 115)},
                   {1.25, Vec3(1, 3, -1), Vec3(229, 29, 143)}};
    return motion;
}

/// Scaled walls that rebound everything without loss.
Obstacles elastic(const Obstacle& shape, const Motion& motion) {
    Obstacles obstacles = only(shape);
    obstacles.wall = WallLaw::scaled;
    obstacles.surfaces = {{.rebound = reboundWith(1.0), .friction = 0.0}};
    obstacles.motions = {motion};
    return obstacles;
}

/// A particle that acts on no other and is not damped, under no gravity.
Setup flightAmong(const Obstacles& obstacles, const Vec3& position, const Vec3& velocity) {
    Material material = *materialPreset("liquid");
    material.damping = 0.0;
    material.friction = 0.0;
    Setup setup = runs::freeSetup(material, StepperKind::velocityVerlet, 0.002);
    setup.obstacles = obstacles;
    append(setup.initial,
           {.position = position, .velocity = velocity, .radius = material.radius, .mass = material.mass});
    return setup;
}

/// A block of liquid in a closed box.
Setup blockIn(const Obstacles& obstacles, StepperKind stepper, double damping) {
    Material material = *materialPreset("liquid");
    material.damping = damping;
    material.mass = 0.1;
    Setup setup = runs::freeSetup(material, stepper, 0.002);
    setup.obstacles = obstacles;
    runs::addPacking(setup, {6, 6, 6});
    return setup;
}

double totalWork(const Simulation& simulation) {
    double work = 0.0;
    for (const ObstacleLoad& load : simulation.loads) work += load.work;
    return work;
}

/// The lowest height of a particle's center over any surface, in its radii.
double lowestHeight(const Simulation& simulation) {
    double lowest = kFar;
    const Particles& particles = simulation.particles;
    for (std::size_t p = 0; p < particles.count(); ++p)
        forEachSurface(
            simulation.setup.obstacles, particles.position[p], simulation.time, kFar,
            [&](const Surface& surface) { lowest = std::min(lowest, surface.height / particles.radius[p]); });
    return lowest;
}

/// A stirrer in a box: a paddle that spins, and a gate that glides up and down.
Setup stirred(StepperKind stepper) {
    Obstacles obstacles;
    obstacles.wall = WallLaw::scaled;
    obstacles.gravity = 9.8;
    obstacles.shapes = {Container{Vec3(-2, -1, -2), Vec3(2, 4, 2)}, Box{Vec3(-0.5, -0.8, -0.1), Vec3(0.5, 0.2, 0.1)},
                        Box{Vec3(0.8, -0.9, -1.9), Vec3(1.0, 2.0, 1.9)}};
    Motion gate;
    gate.pivot = Vec3(0.9, 0.5, 0);
    gate.keys = {{0.0, gate.pivot, Vec3::Zero()}, {0.15, gate.pivot + Vec3(0, 1, 0), Vec3(0, 6, 0)}};
    obstacles.motions = {Motion{}, turning(Vec3(0, 6, 0)), gate};
    obstacles.surfaces.resize(3);
    obstacles.surfaces[1].friction = 0.5;
    Setup setup = blockIn(obstacles, stepper, 1.0);
    setup.gravity = Vec3(0, -9.8, 0);
    return setup;
}

std::string hashOf(Simulation& simulation) {
    return hexadecimal(fnv1aOf(encodeCheckpoint(simulation)));
}

}  // namespace

TEST_CASE("A pose turns points, and its velocities are those of its points", "[motion]") {
    for (const Motion& motion : {winding(), turning(Vec3(1, -2, 0.5), Vec3(1, 0, 0)), gliding(Vec3(1, 2, 3))}) {
        const Vec3 inShape(0.3, -0.7, 1.1);
        for (const double time : {0.1, 0.4, 0.9, 1.2}) {
            const Pose pose = poseAt(motion, time);
            const Vec3 here = pose.toScene(inShape);
            CHECK((pose.toShape(here) - inShape).norm() < 1e-14);
            CHECK((pose.rotation * pose.rotation.transpose() - Matrix3::Identity()).norm() < 1e-14);
            constexpr double kShort = 1e-6;
            const Vec3 moved =
                poseAt(motion, time + kShort).toScene(inShape) - poseAt(motion, time - kShort).toScene(inShape);
            CHECK((moved / (2.0 * kShort) - pose.velocityAt(here)).norm() < 1e-8);
            CHECK(pose.velocityAt(here).norm() <=
                  fastestBetween(motion, time, time + 0.01, (here - pose.position).norm()));
        }
    }
    CHECK(poseAt(winding(), -1.0).position == Vec3::Zero());
    CHECK(poseAt(winding(), 9.0).position == Vec3(1, 3, -1));
    CHECK(poseAt(winding(), 9.0).velocity == Vec3::Zero());
    // A quarter turn about x and then about y takes z to x by way of -y.
    Motion turned;
    turned.angles = Vec3(90, 90, 0);
    CHECK((poseAt(turned, 3.0).rotation * Vec3::UnitZ() - Vec3(0, -1, 0)).norm() < 1e-15);
    CHECK((poseAt(turned, 3.0).rotation * Vec3::UnitY() - Vec3(1, 0, 0)).norm() < 1e-15);
}

TEST_CASE("Obstacles left out because a step keeps them away are not touched in that step", "[motion]") {
    Obstacles placed = stirred(StepperKind::velocityVerlet).obstacles;
    const Obstacles fresh = placed;
    constexpr double kFrom = 0.05;
    constexpr double kTo = 0.08;
    place(placed, kFrom, kTo);
    constexpr double kRadius = 0.15;
    std::uint32_t touched = 0;
    std::uint32_t leftOut = 0;
    for (std::uint64_t k = 0; k < 3000; ++k) {
        const Vec3 point = 2.5 * clouds::randomVector(5, k);
        const double time = kFrom + (kTo - kFrom) * static_cast<double>(k % 11) / 10.0;
        std::vector<double> heights, expected;
        forEachTouched(placed, point, time, kRadius,
                       [&](const Surface& surface) { heights.push_back(surface.height); });
        forEachTouched(fresh, point, time, kRadius,
                       [&](const Surface& surface) { expected.push_back(surface.height); });
        CHECK(heights == expected);
        touched += static_cast<std::uint32_t>(expected.size());
        const double beyond = forEachNear(placed, point, time, kRadius, [](std::size_t /*obstacle*/) {});
        leftOut += std::isfinite(beyond) ? 1U : 0U;
    }
    CHECK(touched > 300);
    CHECK(leftOut > 300);
}

TEST_CASE("An elastic wall at speed u turns v into 2u - v", "[motion]") {
    const double radius = materialPreset("liquid")->radius;
    const std::vector<Obstacle> shapes = {
        Plane{}, Box{Vec3(-1, -1, -1), Vec3(1, 0, 1)}, Sphere{Vec3(0, -1, 0), 1.0},
        Container{Vec3(-3, 0, -3), Vec3(3, 900, 3)},
        revolutionSolid(Revolution(cylinderProfile(1.0, 1.0), true, 0.0), Vec3(0, -0.5, 0))};
    for (const Obstacle& shape : shapes)
        for (const double u : {-1.0, 0.5, 3.0, 50.0})
            for (const double v : {-2.0, -20.0}) {
                Setup setup =
                    flightAmong(elastic(shape, gliding(Vec3(0, u, 0))), Vec3(0, 2 * radius, 0), Vec3(0, v, 0));
                Simulation simulation = start(setup);
                for (int k = 1; k <= 10; ++k) advance(simulation, 0.5 * k * radius);
                CAPTURE(shape.index(), u, v);
                if (v > u) continue;
                CHECK(simulation.particles.velocity[0].y() == Approx(2.0 * u - v).epsilon(1e-6).margin(1e-9));
                CHECK(simulation.loads[0].impulse.y() ==
                      Approx(simulation.particles.mass[0] * 2.0 * (u - v)).epsilon(1e-6).margin(1e-9));
            }
}

TEST_CASE("A wall that nothing but its surface can stop turns v into 2u - v", "[motion]") {
    // So heavy that it reaches the surface itself.
    Setup setup = flightAmong(elastic(Plane{}, gliding(Vec3(0, 5, 0))), Vec3(0, 1, 0), Vec3(0, -100, 0));
    setup.initial.mass[0] = 1e9;
    Simulation simulation = start(setup);
    advance(simulation, 0.05);
    CHECK(simulation.particles.velocity[0].y() == Approx(110.0).epsilon(1e-3));
    CHECK(simulation.steps.held > 0);
}

TEST_CASE("The work of a piston is the energy that a closed column gains", "[motion]") {
    for (const StepperKind stepper :
         {StepperKind::velocityVerlet, StepperKind::linearlyImplicit, StepperKind::automatic}) {
        Obstacles obstacles = elastic(Container{Vec3(-1, -1, -1), Vec3(1, 2, 1)}, Motion{});
        obstacles.shapes.push_back(Box{Vec3(-0.999, 1.2, -0.999), Vec3(0.999, 1.9, 0.999)});
        obstacles.surfaces.push_back(obstacles.surfaces[0]);
        Motion piston;
        piston.pivot = Vec3::Zero();
        piston.keys = {{0.0, Vec3::Zero(), Vec3::Zero()}, {0.4, Vec3(0, -0.7, 0), Vec3::Zero()}};
        obstacles.motions.push_back(piston);
        Setup setup = blockIn(obstacles, stepper, 0.0);
        setup.step = 0.0005;
        Simulation simulation = start(setup);
        const double before = energy(simulation).total();
        for (int k = 1; k <= 12; ++k) advance(simulation, k / 30.0);
        const double gained = energy(simulation).total() - before;
        CAPTURE(nameOf(stepper), before, gained);
        CHECK(gained > 0.1 * before);
        CHECK(totalWork(simulation) == Approx(gained).epsilon(0.01));
    }
}

TEST_CASE("What moves with an obstacle does the same as at rest", "[motion]") {
    const Vec3 velocity(3, -2, 1);
    for (const StepperKind stepper : {StepperKind::velocityVerlet, StepperKind::linearlyImplicit}) {
        Obstacles obstacles = elastic(Sphere{Vec3(0, -2.2, 0), 1.0}, Motion{});
        obstacles.surfaces = {{.rebound = reboundWith(0.3), .friction = 0.4}};
        Setup atRest = blockIn(obstacles, stepper, 1.0);
        for (Vec3& v : atRest.initial.velocity) v += Vec3(0, -3, 0);
        Setup moving = atRest;
        moving.obstacles.motions = {gliding(velocity)};
        for (Vec3& v : moving.initial.velocity) v += velocity;
        Simulation one = start(atRest);
        Simulation other = start(moving);
        for (int k = 1; k <= 4; ++k) {
            advance(one, k * 0.05);
            advance(other, k * 0.05);
        }
        double farthest = 0.0;
        for (std::size_t p = 0; p < one.particles.count(); ++p)
            farthest = std::max(farthest,
                                (other.particles.position[p] - one.time * velocity - one.particles.position[p]).norm());
        CAPTURE(nameOf(stepper));
        CHECK(other.loads[0].impulse.norm() > 0.1);
        CHECK(farthest < 1e-12 * (1.0 + velocity.norm()));
    }
}

TEST_CASE("A thin blade at 100 m/s lets nothing through", "[motion]") {
    for (const StepperKind stepper : {StepperKind::velocityVerlet, StepperKind::linearlyImplicit,
                                      StepperKind::symplecticEuler, StepperKind::automatic}) {
        const Box blade{Vec3(-2.02, -3, -3), Vec3(-2, 3, 3)};
        Setup setup = blockIn(elastic(blade, gliding(Vec3(100, 0, 0))), stepper, 1.0);
        Simulation simulation = start(setup);
        for (int k = 1; k <= 5; ++k) advance(simulation, k * 0.01);
        CAPTURE(nameOf(stepper));
        const double face = -2.0 + 100.0 * simulation.time;
        for (const Vec3& position : simulation.particles.position) CHECK(position.x() >= face - 1e-9);
        CHECK(simulation.loads[0].work > 0.0);
    }
}

TEST_CASE("A paddle that spins at any speed is entered by nothing", "[motion][long]") {
    for (const double spin : {6.0, 60.0, 600.0})
        for (const StepperKind stepper : {StepperKind::velocityVerlet, StepperKind::automatic}) {
            Setup setup = stirred(stepper);
            setup.obstacles.motions[1].spin = Vec3(0, spin, 0);
            for (std::size_t p = setup.initial.count(); p-- > 0;) {
                const Vec3& x = setup.initial.position[p];
                if (std::abs(x.z()) < 0.3 || std::abs(x.x() - 0.9) < 0.3) setup.initial.position[p].y() += 2.2;
            }
            Simulation simulation = start(setup);
            for (int k = 1; k <= 20; ++k) {
                advance(simulation, k * 0.01);
                CAPTURE(spin, nameOf(stepper), simulation.time);
                CHECK(lowestHeight(simulation) > -1e-4);
            }
        }
}

TEST_CASE("Near a fast paddle a resume before any step has the same bits", "[motion][threads]") {
    // A resumed run does not know how far particles are from obstacles, and looks at all.
    Obstacles obstacles = elastic(Box{Vec3(-1.5, -1.5, -0.1), Vec3(1.5, 1.5, 0.1)}, turning(Vec3(0, 12, 0)));
    obstacles.surfaces[0].friction = 0.3;
    Setup setup = flightAmong(obstacles, Vec3(9, 0, 0), Vec3::Zero());
    setup.step = 0.004;
    for (std::uint64_t k = 0; k < 3000; ++k)
        append(setup.initial, {.position = 2.2 * clouds::randomVector(7, k),
                               .velocity = clouds::randomVector(8, k),
                               .radius = 0.2,
                               .mass = 0.1});
    setup.materials[0].repulsion = 0.0;
    recordInMotion(setup.obstacles);
    Simulation whole = start(setup);
    Simulation resumed = start(setup);
    for (int k = 1; k <= 40; ++k) {
        advance(whole, 0.004 * k);
        resumed = decodeCheckpoint(setup, encodeCheckpoint(resumed));
        advance(resumed, 0.004 * k);
    }
    CHECK(hashOf(resumed) == hashOf(whole));
    CHECK(totalWork(whole) != 0.0);
}

TEST_CASE("Obstacles in motion have the same bits after a resume", "[motion]") {
    for (const StepperKind stepper : {StepperKind::velocityVerlet, StepperKind::linearlyImplicit,
                                      StepperKind::symplecticEuler, StepperKind::automatic}) {
        const Setup setup = stirred(stepper);
        Simulation whole = start(setup);
        std::vector<std::uint8_t> halfway;
        for (int k = 1; k <= 6; ++k) {
            advance(whole, k / 30.0);
            if (k == 3) halfway = encodeCheckpoint(whole);
        }
        Simulation resumed = decodeCheckpoint(setup, halfway);
        for (int k = 4; k <= 6; ++k) advance(resumed, k / 30.0);
        CAPTURE(nameOf(stepper));
        CHECK(hashOf(resumed) == hashOf(whole));
        CHECK(totalWork(whole) != 0.0);
    }
}
