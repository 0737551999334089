// Order of convergence, closed forms, and quantities that must be conserved or may only fall.
#include "engine/stepping/step_cache.h"
#include "engine/stepping/take_step.h"

#include <cmath>
#include "tests/catch.h"

#include "engine/core/exp_negative.h"
#include "engine/run/diagnostics.h"
#include "engine/stepping/step_bound.h"
#include "tests/engine/runs.h"

using namespace engine;

namespace {

using runs::freeSetup;

/// Two solid particles about their rest length; amplitude in meters.
Setup oscillator(StepperKind stepper, double step, double amplitude) {
    Material material = *materialPreset("solid");
    material.damping = 0.0;
    Setup setup = freeSetup(material, stepper, step);
    append(setup.initial, {.position = Vec3(0.15 + 0.5 * amplitude, 0, 0)});
    append(setup.initial, {.position = Vec3(-0.15 - 0.5 * amplitude, 0, 0)});
    return setup;
}

/// A damped, moving packing with drag after 0.1 s. No pair gets as close as the core, whose kink would hide the order.
std::vector<Vec3> packingAt(const char* preset, StepperKind stepper, double step) {
    Setup setup = freeSetup(*materialPreset(preset), stepper, step);
    setup.drag = 1.005;
    for (const Vec3& position : gridPositions(Vec3::Zero(), {4, 4, 3}, {.spacing = 0.27, .jitter = 0.1}))
        append(setup.initial, {.position = position, .velocity = clouds::randomVector(3, setup.initial.count())});
    Simulation simulation = start(setup);
    advance(simulation, 0.1);
    return simulation.particles.position;
}

double distanceBetween(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
    double sumSq = 0.0;
    for (std::size_t p = 0; p < a.size(); ++p) sumSq += squaredLength(a[p] - b[p]);
    return std::sqrt(sumSq / static_cast<double>(a.size()));
}

double measuredOrder(const char* preset, StepperKind stepper) {
    const auto reference = packingAt(preset, StepperKind::velocityVerlet, 0.1 / 8192);
    const double coarse = distanceBetween(packingAt(preset, stepper, 0.1 / 128), reference);
    const double fine = distanceBetween(packingAt(preset, stepper, 0.1 / 256), reference);
    return std::log2(coarse / fine);
}

}  // namespace

TEST_CASE("Symplectic Euler is of order 1, velocity Verlet of order 2, with damping and drag", "[steppers]") {
    for (const char* preset : {"liquid", "solid", "powder"}) {
        INFO(preset);
        // The next order contributes less than a tenth at 128 steps.
        CHECK(measuredOrder(preset, StepperKind::symplecticEuler) == Approx(1.0).margin(0.1));
        CHECK(measuredOrder(preset, StepperKind::velocityVerlet) == Approx(2.0).margin(0.1));
    }
}

TEST_CASE("Leapfrog is velocity Verlet without damping, and of order 1 with it", "[steppers]") {
    const auto ends = [](double damping, StepperKind stepper) {
        Setup setup = oscillator(stepper, 1e-3, 0.03);
        setup.materials[0].damping = damping;
        Simulation simulation = start(setup);
        advance(simulation, 0.1);
        return stateHash(simulation.particles);
    };
    CHECK(ends(0.0, StepperKind::leapfrog) == ends(0.0, StepperKind::velocityVerlet));
    CHECK(ends(4.0, StepperKind::leapfrog) != ends(4.0, StepperKind::velocityVerlet));
    for (const char* preset : {"liquid", "solid", "powder"}) {
        INFO(preset);
        CHECK(measuredOrder(preset, StepperKind::leapfrog) == Approx(1.0).margin(0.1));  // as above
    }
}

TEST_CASE("Leapfrog agrees with the paper's stepper, whose velocities are those of half a step earlier", "[steppers]") {
    const double h = 2e-3;
    Setup setup = freeSetup(*materialPreset("solid"), StepperKind::leapfrog, h);
    setup.initial = clouds::strewnUnequal(100, 0.8);
    Simulation leapfrog = start(setup);
    takeStep(leapfrog, h);
    for (std::size_t p = 0; p < 100; ++p)
        setup.initial.velocity[p] = (leapfrog.particles.position[p] - setup.initial.position[p]) / h;
    setup.initial.position = leapfrog.particles.position;
    setup.stepper = StepperKind::symplecticEuler;
    Simulation paper = start(setup);
    for (int step = 0; step < 20; ++step) {
        takeStep(leapfrog, h);
        takeStep(paper, h);
    }
    // Roundings of the velocity that is computed from positions, which twenty steps of a dense packing may amplify by
    // some powers of ten.
    CHECK(runs::rmsDistance(leapfrog.particles, paper.particles) < 1e-9);
    CHECK(runs::rmsDistance(leapfrog.particles, setup.initial) > 1e-2);
}

TEST_CASE("One step of symplectic Euler is equations 7 and 8", "[steppers]") {
    Setup setup = freeSetup(*materialPreset("liquid"), StepperKind::symplecticEuler, 0.01);
    setup.gravity = Vec3(0, -9.8, 0);
    append(setup.initial, {.position = Vec3(1, 2, 3), .velocity = Vec3(1, 0, 0)});
    Simulation simulation = start(setup);
    advance(simulation, 0.01);
    CHECK(simulation.particles.velocity[0].isApprox(Vec3(1, -0.098, 0), 1e-15));
    CHECK(simulation.particles.position[0].isApprox(Vec3(1.01, 2 - 0.00098, 3), 1e-15));
}

TEST_CASE("Two bodies oscillate with the closed-form period", "[steppers]") {
    // Reduced mass 1/2, k = 2 (1 - 1/c_r^2) b1 / D0^5: omega = sqrt(2 k). Phase after five periods measured by
    // position.
    const double omega = std::sqrt(2.0 * 2.0 * 0.75 * 0.8 / std::pow(0.3, 5));
    const double amplitude = 1e-5;
    Simulation simulation = start(oscillator(StepperKind::velocityVerlet, 1e-5, amplitude));
    advance(simulation, 5.25 * 2.0 * M_PI / omega);
    const double gap = simulation.particles.position[0].x() - simulation.particles.position[1].x() - 0.3;
    // A quarter period past a crest: zero, up to the phase error omega^3 dt^2 t/24 = 1.3e-6 and anharmonic shift of
    // about (amplitude/D0)^2 and offset of order (F''/2k) amplitude^2 = 10 amplitude^2/D0.
    CHECK(std::abs(gap) <= amplitude * (1e-5 + 15 * amplitude / 0.3));
}

TEST_CASE("Without damping the energy error falls with the order of the step", "[steppers]") {
    const auto drift = [](double step) {
        Simulation simulation = start(oscillator(StepperKind::velocityVerlet, step, 0.03));
        const double before = energy(simulation).total();
        double largest = 0.0;
        for (int frame = 1; frame <= 50; ++frame) {
            advance(simulation, 0.01 * frame);
            const double now = energy(simulation).total();
            largest = std::max(largest, std::abs(now - before));
        }
        return largest;
    };
    CHECK(std::log2(drift(1e-3) / drift(5e-4)) == Approx(2.0).margin(0.15));  // the share of the next even order
}

TEST_CASE("Damping only removes energy and keeps both momenta", "[steppers]") {
    Setup setup = freeSetup(*materialPreset("solid"), StepperKind::velocityVerlet, 1e-4);
    setup.initial = clouds::strewnUnequal(100, 0.8);
    Simulation simulation = start(setup);
    const Vec3 momentum = linearMomentum(simulation.particles);
    const Vec3 spin = angularMomentum(simulation.particles);
    double before = energy(simulation).total();
    for (int frame = 1; frame <= 20; ++frame) {
        advance(simulation, 0.005 * frame);
        const double now = energy(simulation).total();
        CHECK(now < before);
        before = now;
    }
    double scale = 0.0;
    for (std::size_t p = 0; p < 100; ++p)
        scale += simulation.particles.mass[p] * simulation.particles.velocity[p].norm();
    CHECK((linearMomentum(simulation.particles) - momentum).norm() <= 1e-13 * scale);  // a rounding a step and particle
    CHECK((angularMomentum(simulation.particles) - spin).norm() <= 1e-13 * scale * 3.0);  // arms of up to 3 m
}

TEST_CASE("Drag does not depend on the step", "[steppers]") {
    for (const StepperKind stepper : {StepperKind::symplecticEuler, StepperKind::velocityVerlet})
        for (const double step : {0.1, 0.01, 0.003}) {
            Setup setup = freeSetup(*materialPreset("liquid"), stepper, step);
            setup.drag = 1.005;
            append(setup.initial, {.velocity = Vec3(2, 0, 0)});
            Simulation simulation = start(setup);
            advance(simulation, 1.0);
            CHECK(simulation.particles.velocity[0].x() == Approx(2 * std::exp(-1.005)).epsilon(1e-13));  // 334 products
        }
}

TEST_CASE("The step bound of two bodies is the closed form, and it is the limit", "[steppers]") {
    Simulation pair = start(oscillator(StepperKind::symplecticEuler, 0.01, 0.0));
    const auto bound = stepBound(pair.cache->evaluator.forceField(), pair.particles, StepperKind::symplecticEuler);
    REQUIRE(bound);
    // w^2 = 2 k / m without damping: dt = 2 / w.
    const double stiffness = 2.0 * 0.75 * 0.8 / std::pow(0.3, 5);
    CHECK(bound->seconds ==
          Approx(2.0 / std::sqrt(2.0 * stiffness)).epsilon(1e-12));  // roundings of a root and an eigenvalue
    CHECK_FALSE(bound->byDamping);
    const auto largestGap = [](double step) {
        Simulation simulation = start(oscillator(StepperKind::symplecticEuler, step, 1e-7));
        double largest = 0.0;
        for (int k = 1; k <= 200; ++k) {
            takeStep(simulation, step);
            largest = std::max(
                largest, std::abs(simulation.particles.position[0].x() - simulation.particles.position[1].x() - 0.3));
        }
        return largest;
    };
    CHECK(largestGap(0.95 * bound->seconds) < 1e-6);  // bounded: at most 1/sqrt(1 - 0.95^2) = 3.2 times the amplitude
    CHECK(largestGap(1.05 * bound->seconds) > 1e-3);  // grows by acosh(1.05) = 0.63 an oscillation until it is large
}

TEST_CASE("No step bound without pairs, a damping bound with strong damping", "[steppers]") {
    CHECK_FALSE(stepBound(clouds::forceFieldOf("solid"), clouds::strewn(1, 1.0), StepperKind::velocityVerlet));
    Material honey = *materialPreset("liquid");
    honey.damping = 1000.0;
    const auto bound = stepBound(clouds::forceFieldOf(honey), clouds::strewn(50, 0.4), StepperKind::velocityVerlet);
    REQUIRE(bound);
    CHECK(bound->byDamping);
}

TEST_CASE("The step bound is the limit of a damped pair for each explicit stepper", "[steppers]") {
    // Solid particles at rest length with a hundred times the damping, whose mode at the bound is the fast, damped one.
    Material material = *materialPreset("solid");
    for (const double damping : {4.0, 400.0}) {
        material.damping = damping;
        for (const StepperKind stepper :
             {StepperKind::symplecticEuler, StepperKind::velocityVerlet, StepperKind::leapfrog}) {
            Setup setup = freeSetup(material, stepper, 1.0);
            append(setup.initial, {.position = Vec3(0.15, 0, 0), .velocity = Vec3(1e-7, 0, 0)});
            append(setup.initial, {.position = Vec3(-0.15, 0, 0), .velocity = Vec3(-1e-7, 0, 0)});
            const auto bound = stepBound(clouds::forceFieldOf(material), setup.initial, stepper);
            REQUIRE(bound);
            struct Speeds {
                double last = 0.0, largest = 0.0;
            };
            const auto speeds = [&](double step) {
                Simulation simulation = start(setup);
                Speeds seen;
                for (int k = 0; k < 300; ++k) {
                    takeStep(simulation, step);
                    seen.last = largestSpeed(simulation.particles);
                    seen.largest = std::max(seen.largest, seen.last);
                }
                return seen;
            };
            INFO("b_d = " << damping << ", " << nameOf(stepper) << ", bound " << bound->seconds);
            CHECK(speeds(0.97 * bound->seconds).last < 1e-7);     // 3 % inside the mode shrinks every step
            CHECK(speeds(1.03 * bound->seconds).largest > 1e-5);  // 3 % outside it grows a hundredfold
        }
    }
}

TEST_CASE("Drag removes kinetic energy", "[steppers]") {
    Setup setup = freeSetup(*materialPreset("powder"), StepperKind::velocityVerlet, 1e-3);
    setup.drag = 1.0;
    append(setup.initial, {.velocity = Vec3(3, 4, 0)});
    Simulation simulation = start(setup);
    advance(simulation, 0.5);
    // m v^2/2 exp(-2 k t), to the rounding of 500 products.
    CHECK(energy(simulation).kinetic == Approx(12.5 * std::exp(-1.0)).epsilon(1e-12));
}
