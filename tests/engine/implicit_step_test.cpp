// The implicit steppers: their order, what they conserve, and that they are stable at steps at which explicit ones are
// not.
#include "engine/stepping/implicit_step.h"

#include <cmath>
#include "tests/catch.h"

#include "engine/run/diagnostics.h"
#include "engine/stepping/step_bound.h"
#include "tests/engine/rounding.h"
#include "tests/engine/runs.h"

using namespace engine;

namespace {

constexpr std::array kImplicit = {StepperKind::implicitDamping, StepperKind::linearlyImplicit};

/// A moving block with drag, solved so exactly that the solver has no share in the error.
Setup block(const Material& material, StepperKind stepper) {
    Setup setup = runs::freeSetup(material, stepper, 0.01);
    setup.drag = 1.005;
    setup.solverTolerance = 1e-11;
    runs::addPacking(setup, {3, 3, 3});
    return setup;
}

/// Order of convergence from what halving the step changes, once and once more.
double measuredOrder(const Setup& setup, int steps) {
    const Particles coarse = runs::afterSteps(setup, 0.1, steps).particles;
    const Particles middle = runs::afterSteps(setup, 0.1, 2 * steps).particles;
    const Particles fine = runs::afterSteps(setup, 0.1, 4 * steps).particles;
    return std::log2(runs::rmsDistance(coarse, middle) / runs::rmsDistance(middle, fine));
}

/// Sum of the lengths of the terms of a momentum: of p, or of x cross p.
double sizeOfMomenta(const Particles& particles, bool angular) {
    double sum = 0.0;
    for (std::size_t p = 0; p < particles.count(); ++p) {
        const Vec3 momentum = particles.mass[p] * particles.velocity[p];
        sum += angular ? particles.position[p].cross(momentum).norm() : momentum.norm();
    }
    return sum;
}

double kineticEnergy(const Simulation& simulation) {
    double sum = 0.0;
    for (std::size_t p = 0; p < simulation.particles.count(); ++p)
        sum += 0.5 * simulation.particles.mass[p] * squaredLength(simulation.particles.velocity[p]);
    return sum;
}

}  // namespace

TEST_CASE("Both implicit steppers are of order 2 on liquid, solid, powder and honey", "[implicit-step][long]") {
    for (const Material& material :
         {*materialPreset("liquid"), *materialPreset("solid"), *materialPreset("powder"), runs::honey()})
        for (const StepperKind stepper : kImplicit) {
            INFO(material.name << ", b_d = " << material.damping << ", " << nameOf(stepper));
            // Honey's damping lasts 0.1 ms: shorter steps than that show the order.
            const int steps = material.damping > 10.0 ? 1024 : 128;
            // The next order's share is under a tenth at these steps.
            CHECK(measuredOrder(block(material, stepper), steps) == Approx(2.0).margin(0.1));
        }
}

TEST_CASE("The implicit steppers agree with velocity Verlet", "[implicit-step]") {
    for (const Material& material : {*materialPreset("solid"), runs::honey()}) {
        const auto after = [&](StepperKind stepper, int steps) {
            return runs::afterSteps(block(material, stepper), 0.1, steps).particles;
        };
        const Particles explicitly = after(StepperKind::velocityVerlet, 4096);
        const double change = runs::rmsDistance(explicitly, after(StepperKind::velocityVerlet, 2048));
        for (const StepperKind stepper : kImplicit) {
            const Particles fine = after(stepper, 1024);
            const double tolerance = change + runs::rmsDistance(fine, after(stepper, 512));
            INFO(material.name << ", b_d = " << material.damping << ", " << nameOf(stepper) << ", m: " << tolerance);
            // Order 2: each errs by a third of what halving its step has changed, so both together by a third of this.
            CHECK(runs::rmsDistance(fine, explicitly) <= 0.5 * tolerance);
            CHECK(tolerance < 1e-4 * 0.15);  // small beside a radius, so that the test means something
        }
    }
}

TEST_CASE("Both momenta are conserved at any tolerance of the solver", "[implicit-step]") {
    for (const StepperKind stepper : kImplicit)
        for (const double tolerance : {0.5, 1e-2, 1e-6, 1e-12}) {
            Material material = *materialPreset("solid");
            material.damping = 30.0;
            Setup setup = runs::freeSetup(material, stepper, 1e-3);
            setup.initial = clouds::strewnUnequal(60, 0.7);
            setup.solverTolerance = tolerance;
            Simulation simulation = start(setup);
            const Particles& particles = simulation.particles;
            const Vec3 momentum = linearMomentum(particles);
            const Vec3 spin = angularMomentum(particles);
            double size = sizeOfMomenta(particles, false);
            double spinSize = sizeOfMomenta(particles, true);
            for (int frame = 1; frame <= 10; ++frame) {
                advance(simulation, 0.01 * frame);
                size = std::max(size, sizeOfMomenta(particles, false));
                spinSize = std::max(spinSize, sizeOfMomenta(particles, true));
            }
            INFO(nameOf(stepper) << ", tolerance " << tolerance);
            // Chosen limit of 1e-13, 450 eps: a hundred steps and more, each a rounding or two at random signs.
            CHECK((linearMomentum(particles) - momentum).norm() <= 1e-13 * size);
            CHECK((angularMomentum(particles) - spin).norm() <= 1e-13 * spinSize);  // same
        }
}

TEST_CASE("A falling cloud has the momenta that gravity gives it, at any tolerance of the solver", "[implicit-step]") {
    for (const StepperKind stepper : kImplicit)
        for (const double tolerance : {0.5, 1e-2, 1e-6}) {
            Setup setup = runs::freeSetup(runs::honey(), stepper, 1e-3);
            setup.gravity = Vec3(1, -9.8, 2);
            setup.solverTolerance = tolerance;
            runs::addPacking(setup, {4, 3, 3});
            Simulation simulation = start(setup);
            const Particles& particles = simulation.particles;
            const double mass = 0.1 * static_cast<double>(particles.count());
            const Vec3 expected = linearMomentum(particles) + 0.1 * mass * setup.gravity;
            advance(simulation, 0.1);
            const double size = sizeOfMomenta(particles, false);
            INFO(nameOf(stepper) << ", tolerance " << tolerance);
            CHECK((linearMomentum(particles) - expected).norm() <= 1e-13 * size);  // as without gravity
        }
}

TEST_CASE("A damped pair follows the closed form of the midpoint rule", "[implicit-step]") {
    // Without repulsion the closing speed u obeys (m/2)(u' - u)/h = -c (u' + u)/2 with c taken half a drift later:
    // u' = u (1 - a)/(1 + a), a = h c/m.
    const double h = 0.01, speed = 2.0, distance = 0.4;
    for (const StepperKind stepper : kImplicit)
        for (const double damping : {0.1, 1.0, 100.0, 1e5}) {
            Material material = *materialPreset("liquid");
            material.repulsion = 0.0;
            material.damping = damping;
            Setup setup = runs::freeSetup(material, stepper, h);
            runs::addPair(setup, distance, speed);
            const Simulation simulation = runs::afterSteps(setup, h, 1);
            const double middle = distance - 0.5 * h * speed;
            const double a = h * damping * (1.0 - middle * middle / 0.36) / material.mass;
            const double after = speed * (1.0 - a) / (1.0 + a);
            const auto& velocity = simulation.particles.velocity;
            INFO(nameOf(stepper) << ", b_d = " << damping);
            CHECK(std::abs(velocity[1].x() - velocity[0].x() - after) <= 64 * kEps * speed);  // some dozen roundings
            CHECK(std::abs(runs::gapOf(simulation) - (middle - 0.5 * h * after)) <= 64 * kEps * distance);  // same
        }
}

TEST_CASE("Steps a thousand times beyond the explicit bound of damping are stable", "[implicit-step]") {
    Material material = runs::honey();
    material.damping = 1e5;
    for (const StepperKind stepper : kImplicit) {
        Setup setup = runs::freeSetup(material, stepper, 0.01);
        runs::addPacking(setup, {3, 3, 3});
        const auto bound = stepBound(clouds::forceFieldOf(material), setup.initial, StepperKind::velocityVerlet);
        REQUIRE(bound);
        REQUIRE(bound->byDamping);
        const double h = 1000.0 * bound->seconds;
        const double before = kineticEnergy(start(setup));
        Simulation simulation = start(setup);
        for (int k = 0; k < 100; ++k) {
            takeStep(simulation, h);
            // The midpoint rule never gains from damping; pairs hold less than a thousandth of this energy.
            REQUIRE(kineticEnergy(simulation) <= 1.001 * before);
        }
        setup.stepper = StepperKind::velocityVerlet;
        Simulation explicitly = start(setup);
        for (int k = 0; k < 3; ++k) takeStep(explicitly, h);
        CHECK_FALSE(kineticEnergy(explicitly) < 1e6 * before);  // what the test would see of an unstable step
    }
}

TEST_CASE("The linearly implicit stepper is stable for a stiff pair at ten times the explicit limit",
          "[implicit-step]") {
    // Half drift, kick with w_e^2 = w^2/(1 + h^2 w^2/4), half drift: v^2 (1 - h^2 w_e^2/4) + w_e^2 x^2 is conserved, so
    // a pair that starts at rest never gets further from its rest length than it was.
    Material material = *materialPreset("solid");
    material.damping = 0.0;
    const double stiffness = 2.0 * 0.75 * 0.8 / std::pow(0.3, 5);
    const double h = 20.0 / std::sqrt(2.0 * stiffness / material.mass);
    const double amplitude = 1e-7;
    const auto largest = [&](StepperKind stepper) {
        Setup setup = runs::freeSetup(material, stepper, h);
        runs::addPair(setup, 0.3 + amplitude, 0.0);
        Simulation simulation = start(setup);
        double far = 0.0;
        for (int k = 0; k < 300; ++k) {
            takeStep(simulation, h);
            far = std::max(far, std::abs(runs::gapOf(simulation) - 0.3));
        }
        return far;
    };
    // In the middle of a step the pair is up to h w/2 = 10 amplitudes away, where w^2 differs by 70 amplitudes/D0.
    CHECK(largest(StepperKind::linearlyImplicit) <= amplitude * (1.0 + 300 * 70 * amplitude / 0.3));
    CHECK_FALSE(largest(StepperKind::implicitDamping) <= 1e3 * amplitude);  // beyond h w = 2 it grows
}
