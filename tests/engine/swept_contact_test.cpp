// Particles that meet obstacles: rebounds against an integrator of this file's own, particles that must stay at rest,
// and input that must not make the small steps go on for ever.
#include "engine/obstacles/swept_contact.h"

#include <limits>
#include "tests/catch.h"

#include "engine/obstacles/contact.h"
#include "tests/engine/obstacles.h"
#include "tests/engine/runs.h"

using namespace engine;

namespace {

/// Acceleration of a particle at a height (m) over the plane y = 0, m/s^2.
double accelerationAt(double height, double speed, const Probe& flight, const Obstacles& obstacles) {
    if (height >= flight.radius) return 0.0;
    const Contact contact = contactWith({.height = height}, obstacles, flight);
    return normalForce(contact, speed) / flight.mass;
}

/// Upward speed (m/s) of a particle after it has met the plane y = 0, from m y'' = F(y, y') and the barrier, by the
/// explicit midpoint rule in steps that neither cover more than 10 micrometers nor last more than 1e-3 of a contact.
double reboundOf(const Probe& flight, const Obstacles& obstacles) {
    double y = flight.radius;
    double v = flight.velocity.y();
    const RepulsorLaw& law = obstacles.law;
    const double barrier = law.radius - law.coreFraction * (law.radius + flight.radius);
    for (int k = 0; k < 1000000 && (y < flight.radius || v < 0.0); ++k) {
        const double h = std::min(2e-6, 1e-5 / std::abs(v));
        const double middle = v + 0.5 * h * accelerationAt(y, v, flight, obstacles);
        v += h * accelerationAt(y + 0.5 * h * v, middle, flight, obstacles);
        y += h * middle;
        if (y < -barrier && v < 0.0) v = -v;
    }
    return v;
}

/// The height (m) at which a particle rests on the plane y = 0.
double restingHeight(const Obstacles& obstacles, double mass, double gravity) {
    double low = -0.3, high = 0.15;
    for (int k = 0; k < 60; ++k) {
        const double middle = 0.5 * (low + high);
        const double force = sumContacts(obstacles, {Vec3(0, middle, 0), Vec3::Zero(), 0.15, 2.0}).force.y();
        (force > mass * gravity ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

}  // namespace

TEST_CASE("Rebounds from a plane are those of a hundred times finer steps", "[swept-contact]") {
    const Obstacles floor = only(Plane{});
    for (const double mass : {0.1, 1.0})
        for (const double speed : {1.0, 5.0, 30.0, 100.0, 1000.0}) {
            const double expected = reboundOf(withMass({Vec3::Zero(), Vec3(0, -speed, 0), 0.15, 2.0}, mass), floor);
            for (const double start : {0.15, 0.16, 0.18, 0.2, 0.3, 1.1}) {
                Probe flight = withMass({Vec3(0, start, 0), Vec3(2, -speed, 0), 0.15, 2.0}, mass);
                advanceThroughContacts(floor, flight, 0.5 + 1.0 / speed);
                INFO(mass << " kg at " << speed << " m/s from " << start << " m: " << flight.velocity.y() << " against "
                          << expected);
                CHECK(flight.velocity.y() ==
                      Approx(expected).epsilon(0.02));               // the accuracy that is promised of a rebound
                CHECK(std::abs(flight.velocity.x() - 2.0) < 2e-13);  // no tangential force: a rounding per small step
            }
        }
}

TEST_CASE("Free flight is one product and one sum", "[swept-contact]") {
    Obstacles obstacles = only(Plane{});
    obstacles.shapes.emplace_back(Sphere{Vec3(50, 0, 0), 1.0, false});
    obstacles.shapes.emplace_back(Box{Vec3(-9, 0, 0), Vec3(-8, 1, 1)});
    for (const double duration : {1e-3, 0.1, 0.9}) {
        Probe flight = withMass({Vec3(0.1, 4.0, 0.2), Vec3(1.7, -2.9, 0.3), 0.15, 2.0}, 0.1);
        const Vec3 expected = flight.position + duration * flight.velocity;
        CHECK_FALSE(contactsInStep(obstacles, flight, duration, true).needsSweep);
        advanceThroughContacts(obstacles, flight, duration);
        CHECK(flight.position == expected);
        CHECK(flight.velocity == Vec3(1.7, -2.9, 0.3));
    }
}

TEST_CASE("A particle that passes by an obstacle moves straight on", "[swept-contact]") {
    const Obstacles obstacles = only(Sphere{Vec3::Zero(), 1.0, false});
    Probe flight = withMass({Vec3(-3, 1.16, 0), Vec3(40, 0, 0), 0.15, 2.0}, 0.1);
    advanceThroughContacts(obstacles, flight, 0.15);
    CHECK(flight.velocity == Vec3(40, 0, 0));
    CHECK((flight.position - Vec3(3, 1.16, 0)).norm() < 1e-13);  // a rounding of 3 m for each of some hundred leaps
}

TEST_CASE("The force of the contacts in a step is that of the obstacles", "[swept-contact]") {
    Obstacles corner = only(Plane{});
    corner.shapes.emplace_back(Box{Vec3(-1, -1, -1), Vec3(-0.1, 2, 1)});
    corner.shapes.emplace_back(Sphere{Vec3(0.4, 0.3, 0.2), 0.35, false});
    for (const double friction : {0.0, 0.6})
        for (const double height : {0.05, 0.12, 0.2, 3.0}) {
            const Probe flight = withMass({Vec3(0.0, height, 0.0), Vec3(0.3, -0.7, 0.1), 0.15, 2.0, friction}, 0.1);
            const Probe probe{flight.position, flight.velocity, 0.15, 2.0, friction};
            const ContactSums sums = sumContacts(corner, probe);
            CHECK(contactsInStep(corner, flight, 1e-5, true).force == sums.force);
            CHECK((sums.energy > 0.0) == (height < 1.0));
        }
}

TEST_CASE("Only a contact that is too fast or too stiff for the step is swept", "[swept-contact]") {
    const Obstacles floor = only(Plane{});
    const Probe fast = withMass({Vec3(0, 1, 0), Vec3(0, -100, 0), 0.15, 2.0}, 0.1);
    CHECK(contactsInStep(floor, fast, 0.01, false).needsSweep);
    CHECK_FALSE(contactsInStep(floor, fast, 0.008, false).needsSweep);  // 0.8 of 0.85 m to the contact
    const Probe slow = withMass({Vec3(0, 0.1, 0), Vec3(0, -0.1, 0), 0.15, 2.0}, 0.1);
    // D = 0.6: c = 10 (1 - 0.36/0.4225) = 1.48 kg/s and k = 10 (4/D^5 - 4/(0.65^2 D^3)) = 76 N/m; with 0.1 kg
    // h^2 w^2 + 2 h g is 0.37 at 0.01 s, 2 at 0.037 s, 11 at 0.1 s.
    CHECK_FALSE(contactsInStep(floor, slow, 0.01, true).needsSweep);
    CHECK(contactsInStep(floor, slow, 0.1, true).needsSweep);
    CHECK(contactsInStep(floor, slow, 0.045, true).needsSweep);  // 2.9
    CHECK_FALSE(contactsInStep(floor, slow, 0.1, false).needsSweep);
}

TEST_CASE("A particle at rest on a plane stays at rest", "[swept-contact]") {
    for (const StepperKind stepper : {StepperKind::velocityVerlet, StepperKind::leapfrog, StepperKind::implicitDamping,
                                      StepperKind::linearlyImplicit})
        for (const double step : {1e-3, 1.0 / 60, 1.0 / 30}) {
            Setup setup = runs::freeSetup(*materialPreset("liquid"), stepper, step);
            setup.gravity = Vec3(0, -9.8, 0);
            setup.obstacles = only(Plane{});
            const double height = restingHeight(setup.obstacles, 0.1, 9.8);
            append(setup.initial, {.position = Vec3(0, height, 0), .mass = 0.1});
            Simulation simulation = start(setup);
            double far = 0.0;
            for (int frame = 1; frame <= 30; ++frame) {
                advance(simulation, frame / 30.0);
                far = std::max(far, std::abs(simulation.particles.position[0].y() - height));
            }
            INFO(nameOf(stepper) << " at " << step << " s moved by " << far << " m");
            CHECK(far < 1e-3 * 0.15);
        }
}

TEST_CASE("A particle that starts deep inside an obstacle comes out", "[swept-contact]") {
    struct Case {
        Obstacle obstacle;
        Vec3 position;
        Vec3 out;  ///< outward normal of the nearest face
    };
    const std::vector<Case> cases = {
        {Plane{}, Vec3(0, -0.9, 0), Vec3::UnitY()},
        {Plane{}, Vec3(0, -20, 0), Vec3::UnitY()},
        {Container{Vec3(-1, 0, -1), Vec3(1, 9, 1)}, Vec3(0, -0.9, 0), Vec3::UnitY()},
        {Box{Vec3(-1, -2, -1), Vec3(1, 0, 1)}, Vec3(0.1, -0.7, 0.1), Vec3::UnitY()},
        {Box{Vec3(-1, -0.02, -1), Vec3(1, 0, 1)}, Vec3(0, -0.009, 0), Vec3::UnitY()},
        {Sphere{Vec3(0, -1, 0), 1.0, false}, Vec3(0, -1, 0), Vec3::UnitY()},
    };
    for (const Case& c : cases)
        for (const double mass : {0.01, 0.1, 1.0}) {
            Probe flight = withMass({c.position, Vec3::Zero(), 0.15, 2.0}, mass);
            const Obstacles obstacles = only(c.obstacle);
            for (int call = 0; call < 200 && dot(flight.position, c.out) <= 0.0; ++call)
                advanceThroughContacts(obstacles, flight, 0.01);
            INFO(mass << " kg from " << c.position.transpose() << " is at " << flight.position.transpose());
            CHECK(dot(flight.position, c.out) > 0.0);
        }
}

TEST_CASE("Motion with NaN or overflowing speeds ends", "[swept-contact]") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const double infinity = std::numeric_limits<double>::infinity();
    for (const Obstacle& obstacle : std::vector<Obstacle>{Plane{}, Box{Vec3(-1, -1, -1), Vec3(1, 1, 1)}, Sphere{}})
        for (const double bad : {nan, infinity, 1e300, 1e160}) {
            Probe flight = withMass({Vec3(0.2, 2, 0.1), Vec3(0, -bad, 0), 0.15, 2.0}, 0.1);
            advanceThroughContacts(only(obstacle), flight, 0.01);
            CHECK_FALSE(std::abs(flight.velocity.y()) < 1e100);
            Probe nowhere = withMass({Vec3(0.2, bad, 0.1), Vec3(0, -1, 0), 0.15, 2.0}, 0.1);
            advanceThroughContacts(only(obstacle), nowhere, 0.01);
            CHECK_FALSE(std::abs(nowhere.position.y()) < 1e100);
        }
}
