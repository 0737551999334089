// What single steps tell of their errors, the filter that makes steps of it, and the comparison with a twin.
#include "engine/error_control/step_control.h"

#include <algorithm>
#include <cmath>
#include "tests/catch.h"

#include "engine/error_control/checked_steps.h"
#include "engine/error_control/twin.h"
#include "engine/run/advance.h"
#include "engine/run/diagnostics.h"
#include "engine/stepping/take_step.h"
#include "tests/engine/runs.h"

using namespace engine;

namespace {

/// A pressed lattice that flies apart, without damping.
Setup flyingApart() {
    Material material = *materialPreset("liquid");
    material.damping = 0.0;
    Setup setup = runs::freeSetup(material, StepperKind::velocityVerlet, 0.01);
    runs::addPacking(setup, {4, 4, 4});
    for (Vec3& position : setup.initial.position) position *= 0.9;
    return setup;
}

double rms(const Particles& a, const Particles& b) {
    return runs::rmsDistance(a, b) / a.radius[0];
}

/// The estimate of the last of two steps of h seconds, over the local error of that step, radii per second.
double estimateOverError(StepperKind stepper, double h) {
    Setup setup = flyingApart();
    setup.stepper = stepper;
    setup.step = h;
    setup.solverTolerance = 1e-12;
    Simulation simulation = start(setup);
    SavedState before;
    for (int k = 1; k <= 2; ++k) {
        save(simulation, before);
        ErrorControl errors{{.step = h}, 1e9};
        CHECK(advanceChecked(simulation, k * h, h, StepLimit::error, 1e9, &errors));
        if (k == 1) continue;
        Setup fine = setup;
        fine.initial.position = before.position;
        fine.initial.velocity = before.velocity;
        fine.stepper = StepperKind::velocityVerlet;
        fine.step = h / 64;
        Simulation reference = start(fine);
        advance(reference, h);
        return errors.estimate / h / (rms(simulation.particles, reference.particles) / h);
    }
    return 0.0;
}

}  // namespace

TEST_CASE("The estimate of a step is its local error", "[step-control]") {
    for (const StepperKind stepper : {StepperKind::velocityVerlet, StepperKind::linearlyImplicit})
        for (const double h : {0.004, 0.002}) {
            const double ratio = estimateOverError(stepper, h);
            INFO(nameOf(stepper) << ", h " << h << ": " << ratio);
            CHECK(ratio > 0.5);
            CHECK(ratio < 4.0);  // a constant of the stepper, which the calibration finds
        }
    // The constant is the same for all steps.
    CHECK(estimateOverError(StepperKind::velocityVerlet, 0.004) ==
          Approx(estimateOverError(StepperKind::velocityVerlet, 0.002)).epsilon(0.1));
}

TEST_CASE("The filter holds a step that is right and corrects one that is not", "[step-control]") {
    const auto steady = [](double first, double errorAtOne) {
        StepControl steps{.step = first};
        for (int k = 0; k < 60; ++k)
            control(steps, StepperKind::velocityVerlet, steps.step, errorAtOne * steps.step * steps.step, 0.1);
        return steps.step;
    };
    // An error of 1000 h^2 is 0.1 at h = 0.01.
    CHECK(steady(0.01, 1000.0) == Approx(0.01).epsilon(1e-12));
    CHECK(steady(0.1, 1000.0) == Approx(0.01).epsilon(0.01));
    CHECK(steady(1e-5, 1000.0) == Approx(0.01).epsilon(0.01));

    StepControl steps{.step = 0.01};
    control(steps, StepperKind::velocityVerlet, 0.01, 10.0, 0.1);  // an impact
    CHECK(steps.step == Approx(0.01 / 3.0));
    steps = {.step = 0.01};
    control(steps, StepperKind::velocityVerlet, 0.01, 0.0, 0.1);
    CHECK(steps.step == Approx(0.02));
    steps = {.step = 0.01};
    control(steps, StepperKind::velocityVerlet, 0.0005, 1e-9, 0.1);  // an emission ended it
    CHECK(steps.step == 0.01);
    steps = {.step = 0.01};
    control(steps, StepperKind::velocityVerlet, 0.005, 0.025, 0.1);  // half as long, a quarter of the error
    CHECK(steps.step == Approx(0.01));
    CHECK(isRefused({.calibration = 2.0, .isCalibrated = true}, 0.6, 0.1));
    CHECK_FALSE(isRefused({.calibration = 2.0, .isCalibrated = true}, 0.4, 0.1));
    CHECK_FALSE(isRefused({.calibration = 2.0}, 0.6, 0.1));
}

TEST_CASE("A twin does not change the run, and tells its error", "[step-control]") {
    Setup setup = flyingApart();
    setup.stepper = StepperKind::automatic;
    setup.error = 0.001;
    Simulation simulation = start(setup);
    const double interval = 1.0 / 60;
    StepControl& steps = simulation.automatic.controls[static_cast<std::size_t>(StepperKind::velocityVerlet)];
    steps.step = 0.002;
    const std::string before = stateHash(simulation.particles);
    constexpr double kAnyCost = std::numeric_limits<double>::infinity();
    sendTwin(simulation, interval, kAnyCost);
    const TwinRun& twin = simulation.automatic.twin;
    CHECK(stateHash(simulation.particles) == before);
    CHECK(twin.exists);
    CHECK(twin.end == Approx(0.2));
    CHECK(twin.position.size() == simulation.particles.count());
    CHECK(simulation.automatic.estimateCost > 0.0);

    ErrorControl errors{steps, setup.error};
    for (int k = 1; k <= 12; ++k)
        CHECK(advanceChecked(simulation, k * interval, interval, StepLimit::error, kAnyCost, &errors));
    simulation.automatic.twin.runEstimate = errors.estimate;
    const Comparison compared = compareWithTwin(simulation);
    Setup fine = setup;
    fine.stepper = StepperKind::velocityVerlet;
    fine.step = twin.step / 48;
    Simulation reference = start(fine);
    advance(reference, twin.end);
    const double real = rms(simulation.particles, reference.particles) / 0.2;
    const double found = compared.distance / (twin.estimate / compared.estimate - 1.0);
    INFO("real " << real << ", found " << found << ", contrast " << twin.estimate / compared.estimate);
    CHECK(found < 1.5 * real);  // chosen factor: errors are only about as large as the estimates
    CHECK(found > real / 1.5);
}

TEST_CASE("A twin that would cost too much is given up", "[step-control]") {
    Setup setup = flyingApart();
    setup.stepper = StepperKind::automatic;
    Simulation simulation = start(setup);
    const double interval = 1.0 / 60;
    simulation.automatic.controls[static_cast<std::size_t>(StepperKind::velocityVerlet)].step = interval / 20;
    sendTwin(simulation, interval, 50.0);  // 5 force evaluations until the middle, of 10 that it takes
    CHECK_FALSE(simulation.automatic.twin.exists);
    CHECK(simulation.automatic.estimateCost > 5.0);
    CHECK(simulation.automatic.estimateCost < 8.0);

    simulation.automatic.estimateCost = 0.0;
    simulation.automatic.controls[static_cast<std::size_t>(StepperKind::linearlyImplicit)].step = interval / 20;
    sendCandidate(simulation, StepperKind::linearlyImplicit, interval, 120.0);  // 2 an interval, of 7 that it takes
    CHECK_FALSE(simulation.automatic.twin.exists);
    CHECK(simulation.automatic.estimateCost > 4.0);  // an interval, and one of credit
    CHECK(simulation.automatic.estimateCost < 20.0);
}

TEST_CASE("A fall is without error for every Verlet stepper", "[step-control]") {
    for (const StepperKind stepper : {StepperKind::velocityVerlet, StepperKind::leapfrog}) {
        Setup setup = runs::freeSetup(*materialPreset("liquid"), stepper, 0.01);
        setup.gravity = Vec3(0, -9.8, 0);
        runs::addPair(setup, 1.0, 0.0);
        Simulation simulation = start(setup);
        advance(simulation, 0.05);
        INFO(nameOf(stepper));
        CHECK(simulation.cache->predictionError < 1e-12);
    }
}

TEST_CASE("Rest is without error for every Verlet stepper", "[step-control]") {
    for (const StepperKind stepper : {StepperKind::velocityVerlet, StepperKind::leapfrog}) {
        Setup setup = runs::freeSetup(*materialPreset("liquid"), stepper, 0.01);
        setup.gravity = Vec3(0, -9.8, 0);
        setup.obstacles.shapes = {Plane{Vec3(0, -0.7, 0), Vec3::UnitY()}};
        runs::addPair(setup, 0.5, 0.0);
        for (Vec3& position : setup.initial.position) std::swap(position.x(), position.y());  // one above the other
        Simulation simulation = start(setup);
        advance(simulation, 30.0);  // long enough for the bounces to die away
        INFO(nameOf(stepper));
        CHECK(simulation.particles.velocity[0].norm() < 0.01);
        // A tenth of what gravity does in half a step to one of the two.
        CHECK(simulation.cache->predictionError <
              0.1 * 0.5 * 0.01 * 9.8 / simulation.particles.radius[0] / std::sqrt(2.0));
    }
}
