// The force of scaled walls on single particles: restitution, rest, friction and adhesion.
#include "engine/obstacles/contact.h"

#include <cmath>
#include <vector>
#include "tests/catch.h"

#include "engine/obstacles/swept_contact.h"
#include "engine/run/advance.h"
#include "engine/run/diagnostics.h"
#include "tests/engine/obstacles.h"
#include "tests/engine/runs.h"

using namespace engine;

namespace {

constexpr double kGravity = 9.8;

Obstacles scaled(const Obstacle& shape, const WallSurface& surface = {}, double gravity = kGravity) {
    Obstacles obstacles = only(shape);
    obstacles.wall = WallLaw::scaled;
    obstacles.surfaces = {surface};
    obstacles.gravity = gravity;
    return obstacles;
}

/// A particle of a material at a height (m) over the plane y = 0.
Probe particleOf(const Material& material, double height, const Vec3& velocity) {
    return {Vec3(0, height, 0), velocity,      material.radius,   material.dampingReach,
            material.friction,  material.mass, material.repulsion};
}

/// Speed after a rebound from the plane y = 0 over the speed before.
double restitutionOf(const Material& material, double speed, double restitution) {
    const Obstacles floor = scaled(Plane{}, {.rebound = reboundWith(restitution)});
    Probe particle = particleOf(material, 1.5 * material.radius, Vec3(0, -speed, 0));
    for (int call = 0; call < 2000 && !(particle.velocity.y() > 0.0 && particle.position.y() > material.radius); ++call)
        advanceThroughContacts(floor, particle, 0.1 * material.radius / speed);
    return particle.velocity.y() / speed;
}

/// A simulation of one particle over a surface.
Simulation alone(const Material& material, const Obstacles& obstacles, const Vec3& position, const Vec3& gravity) {
    Setup setup = runs::freeSetup(material, StepperKind::velocityVerlet, 1e-3);
    setup.gravity = gravity;
    setup.obstacles = obstacles;
    append(setup.initial, {.position = position, .radius = material.radius, .mass = material.mass});
    return start(setup);
}

}  // namespace

TEST_CASE("A particle rebounds from a scaled wall with its restitution, at any speed", "[scaled-walls]") {
    for (const char* preset : {"liquid", "solid", "honey", "sand"})
        for (const double restitution : {0.05, 0.2, 0.5, 0.9, 1.0}) {
            const Material material = *materialPreset(preset);
            // The speed at which an undamped particle would just reach the surface.
            const Probe atSurface = particleOf(material, 0.0, Vec3::Zero());
            const double energy = sumContacts(scaled(Plane{}), atSurface).energy;
            const double fastest = std::sqrt(2.0 * energy / material.mass);
            for (const double share : {0.01, 0.1, 0.5, 0.9}) {
                INFO(preset << ", restitution " << restitution << ", " << share << " of " << fastest << " m/s");
                CHECK(restitutionOf(material, share * fastest, restitution) ==
                      Approx(restitution).epsilon(0.03).margin(0.003));  // of the second-order steps of the sweep
            }
            // Far above it, the surface itself reflects the particle.
            CHECK(restitutionOf(material, 100.0 * fastest, restitution) ==
                  Approx(restitution).margin(0.02));  // the force damps a little more
        }
}

TEST_CASE("The same restitution holds for a particle of any mass and radius", "[scaled-walls]") {
    for (const double radius : {0.001, 0.05, 0.4})
        for (const double mass : {1e-6, 1.0, 1e4}) {
            Material material = *materialPreset("liquid");
            material.radius = radius;
            material.mass = mass;
            material.repulsion *= std::pow(radius / 0.15, 5.0);  // of the same stiffness
            for (const double speed : {0.1, 3.0, 300.0}) {
                INFO(radius << " m, " << mass << " kg, " << speed << " m/s");
                // Where the force stops the particle halfway, it damps what the surface has reflected.
                CHECK(restitutionOf(material, speed, 0.4) == Approx(0.4).margin(0.09));
            }
        }
}

TEST_CASE("A particle of any mass lies on a scaled wall at no less than half its radius", "[scaled-walls]") {
    for (const double radius : {0.02, 0.15})
        for (const double mass : {1e-3, 1.0, 1e3}) {
            Material material = *materialPreset("liquid");
            material.radius = radius;
            material.mass = mass;
            Simulation simulation = alone(material, scaled(Plane{}), Vec3(0, 2.0 * radius, 0), Vec3(0, -kGravity, 0));
            advance(simulation, 2.0);
            INFO(radius << " m, " << mass << " kg");
            CHECK(simulation.particles.position[0].y() > 0.499 * radius);
            CHECK(simulation.particles.position[0].y() < radius);
            CHECK(largestSpeed(simulation.particles) < 0.01 * radius);  // a hundredth of a radius a second
            CHECK(simulation.wallDepths.deepest < 1.0);
        }
}

TEST_CASE("A wall's friction replaces that of the material", "[scaled-walls]") {
    // Down a slope of 30 degrees, a particle accelerates with g (sin - mu cos), or stays.
    const double slope = std::numbers::pi / 6.0;
    const Vec3 normal(std::sin(slope), std::cos(slope), 0.0);
    Material material = *materialPreset("solid");
    material.friction = 0.9;
    for (const double friction : {0.0, 0.2, 0.4, 0.7}) {
        Simulation simulation = alone(material, scaled(Plane{Vec3::Zero(), normal}, {.friction = friction}),
                                      Vec3(0.9 * material.radius * normal), Vec3(0, -kGravity, 0));
        advance(simulation, 0.5);
        const double before = simulation.particles.velocity[0].norm();
        advance(simulation, 1.5);
        const double acceleration = simulation.particles.velocity[0].norm() - before;
        const double expected = std::max(0.0, kGravity * (std::sin(slope) - friction * std::cos(slope)));
        INFO("friction " << friction);
        CHECK(acceleration == Approx(expected).margin(0.01 * kGravity));
    }
}

TEST_CASE("An adhesive ceiling holds a layer that is lighter than its stress", "[scaled-walls]") {
    const Material material = *materialPreset("honey");
    const double area = 2.0 * std::sqrt(3.0) * material.radius * material.radius;
    const double weight = material.mass * kGravity / area;  // stress that just carries a particle
    for (const double share : {0.5, 0.9, 1.1, 3.0}) {
        Simulation simulation =
            alone(material, scaled(Plane{Vec3::Zero(), -Vec3::UnitY()}, {.adhesion = share * weight}),
                  Vec3(0, -0.9 * material.radius, 0), Vec3(0, -kGravity, 0));
        advance(simulation, 1.0);
        INFO(share << " of the weight");
        CHECK((simulation.particles.position[0].y() > -material.radius) == (share > 1.0));
        CHECK((simulation.particles.position[0].y() < -1.0) == (share < 1.0));
    }
}

TEST_CASE("The energy of a contact is the work of its conservative force", "[scaled-walls]") {
    for (const double adhesion : {0.0, 50.0}) {
        const Obstacles floor = scaled(Plane{}, {.adhesion = adhesion});
        const Material material = *materialPreset("honey");
        const auto at = [&](double height) { return sumContacts(floor, particleOf(material, height, Vec3::Zero())); };
        double work = 0.0;
        constexpr int kSteps = 20000;
        const double top = 2.5 * material.radius;
        const double step = top / kSteps;
        for (int k = 0; k < kSteps; ++k) work += at(top - (k + 0.5) * step).force.y() * step;
        CHECK(at(top).energy == 0.0);
        CHECK(at(0.0).energy == Approx(work).epsilon(1e-6));  // of the midpoint rule
    }
}
