// Friction: Coulomb's law on one grain, conservation of momentum, loss of energy, and the slope of a heap.
#include <cmath>
#include "tests/catch.h"

#include "engine/run/diagnostics.h"
#include "engine/stepping/step_audit.h"
#include "engine/stepping/step_cache.h"
#include "tests/engine/runs.h"

using namespace engine;

namespace {

constexpr std::array kOurs = {StepperKind::velocityVerlet, StepperKind::leapfrog, StepperKind::implicitDamping,
                              StepperKind::linearlyImplicit};

Material grain(double friction) {
    Material material = *materialPreset("powder");
    material.mass = 0.1;
    material.friction = friction;
    return material;
}

/// Slope, in degrees, of what a column of 490 grains has become on a floor after three seconds: that of the cone with
/// the same mean height (a quarter of the cone's height) and mean squared distance from the axis (3/10 R^2).
double slopeOfHeap(double friction) {
    Setup setup = runs::freeSetup(grain(friction), StepperKind::velocityVerlet, 0.005);
    setup.gravity = Vec3(0, -9.81, 0);
    setup.obstacles.shapes = {Plane{}};
    for (const Vec3& position : gridPositions(Vec3(0, 1.5, 0), {7, 10, 7}, {.spacing = 0.3, .jitter = 0.1}))
        append(setup.initial, {.position = position, .mass = 0.1});
    Simulation simulation = start(setup);
    for (int frame = 1; frame <= 90; ++frame) advance(simulation, frame / 30.0);
    const Particles& grains = simulation.particles;
    const auto count = static_cast<double>(grains.count());
    Vec3 middle = Vec3::Zero();
    for (const Vec3& x : grains.position) middle += x / count;
    double spread = 0.0;
    for (const Vec3& x : grains.position) {
        const Vec3 apart = x - middle;
        spread += (apart.x() * apart.x() + apart.z() * apart.z()) / count;
    }
    return std::atan2(4.0 * middle.y(), std::sqrt(spread / 0.3)) * 180.0 / M_PI;
}

}  // namespace

TEST_CASE("A sliding grain stops where Coulomb's law says", "[friction]") {
    for (const StepperKind stepper : kOurs)
        for (const double friction : {0.3, 0.8}) {
            Setup setup = runs::freeSetup(grain(friction), stepper, 0.002);
            setup.gravity = Vec3(0, -9.8, 0);
            setup.obstacles.shapes = {Plane{}};
            append(setup.initial, {.position = Vec3(0, 0.15, 0), .mass = 0.1});
            Simulation simulation = start(setup);
            advance(simulation, 2.0);  // until it is at rest on the floor
            const double from = simulation.particles.position[0].x();
            simulation.particles.velocity[0].x() = 2.0;
            simulation.cache->forcesCurrent = false;
            simulation.cache->energy.reset();
            advance(simulation, 4.0);
            const double way = simulation.particles.position[0].x() - from;
            INFO(nameOf(stepper) << ", friction " << friction << ": " << way << " m");
            CHECK(way == Approx(2.0 * 2.0 / (2.0 * friction * 9.8)).epsilon(0.01));  // a few steps of 4 mm in 0.25 m
        }
}

TEST_CASE("Friction keeps linear momentum and gains no energy", "[friction]") {
    for (const StepperKind stepper : kOurs) {
        Setup setup = runs::freeSetup(grain(0.7), stepper, 0.004);
        runs::addPacking(setup, {5, 5, 5});
        Simulation simulation = start(setup);
        const Vec3 before = linearMomentum(simulation.particles);
        double sum = 0.0;
        for (std::size_t p = 0; p < simulation.particles.count(); ++p)
            sum += simulation.particles.mass[p] * simulation.particles.velocity[p].norm();
        double last = energy(simulation).total();
        for (int frame = 1; frame <= 15; ++frame) {
            const std::uint64_t stepsBefore = simulation.steps.count;
            advance(simulation, frame / 30.0);
            const Energy now = energy(simulation);
            const auto steps = static_cast<double>(simulation.steps.count - stepsBefore);
            INFO(nameOf(stepper) << ", frame " << frame << ": " << last << " J, then " << now.total() << " J");
            CHECK(now.total() <= last + steps * energyAllowance(simulation));
            last = now.total();
        }
        CHECK((linearMomentum(simulation.particles) - before).norm() < 1e-13 * sum);  // as friction promises
    }
}

TEST_CASE("More friction leaves less slip, and never reverses it", "[friction]") {
    const auto slipAfter = [](double friction) {
        Setup setup = runs::freeSetup(grain(friction), StepperKind::velocityVerlet, 0.001);
        append(setup.initial, {.position = Vec3(0, 0, 0), .velocity = Vec3(0, 0, 0.5), .mass = 0.1});
        append(setup.initial, {.position = Vec3(0.27, 0, 0), .velocity = Vec3(0, 0, -0.5), .mass = 0.1});
        Simulation simulation = start(setup);
        advance(simulation, 0.05);
        return simulation.particles.velocity[0].z() - simulation.particles.velocity[1].z();
    };
    CHECK(slipAfter(0.0) > slipAfter(0.2));
    CHECK(slipAfter(0.2) > slipAfter(0.6));
    CHECK(slipAfter(0.6) > 0.0);
}

TEST_CASE("Grains heap up with friction and spread without it", "[friction]") {
    const double without = slopeOfHeap(0.0);
    const double little = slopeOfHeap(0.2);
    const double sand = slopeOfHeap(0.6);
    INFO("slopes of " << without << ", " << little << " and " << sand << " degrees");
    CHECK(without < 5.0);  // a layer one grain high
    CHECK(little > 2.0 * without);
    CHECK(sand > little);
    CHECK(sand > 12.0);  // chosen: a column slumps to less than the angle of a poured heap
}
