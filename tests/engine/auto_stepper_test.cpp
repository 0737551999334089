// The automatic stepper: its error estimates are right, its choices fit the substance and the wanted error, and they
// depend on nothing but the states.
#include "engine/error_control/auto_stepper.h"

#include "tests/catch.h"

#include "engine/error_control/error_estimate.h"
#include "engine/error_control/step_cost.h"
#include "engine/error_control/twin.h"
#include "engine/run/diagnostics.h"
#include "engine/stepping/step_cache.h"
#include "tests/engine/runs.h"

using namespace engine;

namespace {

/// A block that falls on a floor.
Setup fallingBlock(const Material& material, const std::array<std::uint32_t, 3>& counts = {4, 4, 4}) {
    Setup setup = runs::freeSetup(material, StepperKind::automatic, 0.01);
    setup.gravity = Vec3(0, -9.8, 0);
    setup.obstacles.shapes = {Plane{Vec3(0, -0.7, 0), Vec3::UnitY()}};
    runs::addPacking(setup, counts);
    return setup;
}

Simulation afterFrames(const Setup& setup, int frames) {
    Simulation simulation = start(setup);
    for (int frame = 1; frame <= frames; ++frame) advance(simulation, frame / 30.0);
    return simulation;
}

/// RMS over the particles of dx + T dv in radii per second of motion, which is what measure() estimates.
double realError(const Simulation& run, const Simulation& reference, double interval, double horizon = kErrorHorizon) {
    double sumSq = 0.0;
    for (std::size_t p = 0; p < run.particles.count(); ++p) {
        const Vec3 apart = run.particles.position[p] - reference.particles.position[p] +
                           horizon * (run.particles.velocity[p] - reference.particles.velocity[p]);
        sumSq += squaredLength(apart) / (run.particles.radius[p] * run.particles.radius[p]);
    }
    return std::sqrt(sumSq / static_cast<double>(run.particles.count())) / interval;
}

/// Runs from the particles of a simulation, taken as the state at time zero, to a time.
Simulation fixedRun(const Simulation& from, StepperKind stepper, double step, double time) {
    Setup setup = from.setup;
    setup.initial = from.particles;
    setup.stepper = stepper;
    setup.step = step;
    Simulation simulation = start(setup);
    advance(simulation, time);
    return simulation;
}

}  // namespace

TEST_CASE("The estimated error is that against a reference", "[auto-stepper]") {
    const double interval = 1.0 / 30;
    for (const Material& material : {*materialPreset("liquid"), *materialPreset("solid"), runs::honey()})
        for (const StepperKind stepper : {StepperKind::velocityVerlet, StepperKind::leapfrog,
                                          StepperKind::implicitDamping, StepperKind::linearlyImplicit}) {
            if (material.damping > 10.0 && isVerlet(stepper)) continue;  // the audit shortens its steps
            Setup setup = fallingBlock(material, {3, 3, 3});
            setup.stepper = stepper;
            setup.solverTolerance = 1e-8;
            const Simulation simulation = start(setup);
            const std::string before = stateHash(simulation.particles);
            const Trial trial = measure(simulation, {interval, stepper, interval / 32});
            const Simulation coarse = fixedRun(simulation, stepper, interval / 32, interval);
            const double real = realError(coarse, fixedRun(simulation, stepper, interval / 2048, interval), interval);
            INFO(material.name << ", b_d = " << material.damping << ", " << nameOf(stepper) << ": measured "
                               << trial.error << ", real " << real);
            CHECK(stateHash(simulation.particles) == before);
            CHECK(trial.step == Approx(interval / 32).epsilon(1e-12));  // rounding of the division
            CHECK(trial.error <
                  1.5 * real);  // chosen factor: the next order of Richardson's estimate contributes about a tenth here
            CHECK(trial.error > real / 1.5);  // same
        }
}

TEST_CASE("A trial that would take too many force evaluations is given up, and says so", "[auto-stepper]") {
    Simulation simulation = start(fallingBlock(runs::honey(), {3, 3, 3}));
    const TrialRun whole{1.0 / 30, StepperKind::velocityVerlet, 1.0 / 60};  // the audit makes hundreds of steps of two
    const Trial free = measure(simulation, whole);
    REQUIRE(free.finished);
    TrialRun limited = whole;
    limited.mostEvaluations = 20;
    const Trial trial = measure(simulation, limited);
    CHECK_FALSE(trial.finished);
    CHECK(trial.spent > 20);
    CHECK(trial.spent < 23);  // the limit, and the evaluations of the last step
    limited.mostEvaluations = free.spent;
    CHECK(measure(simulation, limited).error == free.error);
}

TEST_CASE("Honey is stepped implicitly, plain liquid is not", "[auto-stepper]") {
    CHECK(afterFrames(fallingBlock(*materialPreset("liquid")), 30).stepper == StepperKind::velocityVerlet);
    const Simulation honey = afterFrames(fallingBlock(runs::honey()), 30);
    CHECK(honey.stepper == StepperKind::linearlyImplicit);
    CHECK(honey.cache->toleratedAcceleration > 0.0);
}

TEST_CASE("The error that is wanted is met, as far as the motion can be followed", "[auto-stepper][long]") {
    for (const char* preset : {"liquid", "powder", "oil"})
        for (const double wanted : {0.1, 0.02}) {
            Setup setup = fallingBlock(*materialPreset(preset), {5, 5, 5});
            setup.error = wanted;
            Simulation simulation = start(setup);
            double sum = 0.0;
            constexpr int kWindows = 6;
            for (int window = 0; window < kWindows; ++window) {
                const Simulation before = simulation;
                for (int frame = 1; frame <= 6; ++frame) advance(simulation, (6 * window + frame) / 30.0);
                Simulation reference = before;
                reference.setup.stepper = StepperKind::velocityVerlet;
                reference.setup.step = 1.0 / 9600;
                reference.stepper = StepperKind::velocityVerlet;
                advance(reference, simulation.time);
                sum += realError(simulation, reference, 0.2, 0.0);
            }
            INFO(preset << ": wanted " << wanted << ", obtained " << sum / kWindows);
            CHECK(sum / kWindows < 1.5 * wanted);
            CHECK(sum / kWindows > 0.1 * wanted);
        }
}

TEST_CASE("Error control spends little on anything but the steps of the run", "[auto-stepper]") {
    for (const char* preset : {"liquid", "powder", "honey"}) {
        Setup setup = fallingBlock(*materialPreset(preset), {5, 5, 5});
        setup.error = 0.05;
        const Simulation simulation = afterFrames(setup, 120);
        INFO(preset << ": " << simulation.automatic.estimateCost << " beside " << forceEvaluationsOf(simulation));
        CHECK(simulation.automatic.twinCount >= 4);
        CHECK(simulation.automatic.estimateCost < 0.5 * forceEvaluationsOf(simulation));
    }
}

TEST_CASE("The solver's tolerance costs a small share of the wanted error, and saves products", "[auto-stepper]") {
    for (const double error : {0.2, 0.02}) {
        Setup setup = fallingBlock(runs::honey());
        setup.stepper = StepperKind::implicitDamping;
        setup.step = 1.0 / 120;
        setup.solverTolerance = 1e-9;
        setup.error = error;
        const auto run = [&](double tolerated) {
            Simulation simulation = start(setup);
            simulation.cache->toleratedAcceleration = tolerated;
            advance(simulation, 0.5);
            return simulation;
        };
        const Simulation whole = run(0.0);
        const Simulation cut = run(acceptableResidual(whole));
        const double off = runs::rmsDistance(cut.particles, whole.particles) / whole.particles.radius[0] / 0.5;
        INFO("wanted " << error << ", off by " << off << ", products " << cut.steps.products << " of "
                       << whole.steps.products);
        CHECK(off > 0.0);
        CHECK(off < 0.2 * error);  // the share that acceptableResidual() allows; honey damps what is left out
        CHECK(2 * cut.steps.products <
              whole.steps.products);  // against a solution to 1e-9; measured: a sixth and a quarter
    }
}

TEST_CASE("The solver never leaves out the only force of a motion", "[auto-stepper]") {
    // A pressed pair without gravity, at a wanted error that would leave out all its force.
    Setup setup = runs::freeSetup(runs::honey(), StepperKind::implicitDamping, 1.0 / 60);
    setup.error = 1e4;
    runs::addPair(setup, 0.8 * 2 * setup.materials[0].radius, 0.0);
    const auto movedBy = [&](double tolerated) {
        Simulation simulation = start(setup);
        simulation.cache->toleratedAcceleration = tolerated;
        advance(simulation, 0.5);
        return runs::rmsDistance(simulation.particles, setup.initial);
    };
    const double whole = movedBy(0.0);
    CHECK(whole > 0.0);
    CHECK(movedBy(acceptableResidual(start(setup))) == Approx(whole).epsilon(kMostLeftOut));
}

TEST_CASE("A smaller error takes more and smaller steps", "[auto-stepper]") {
    for (const char* preset : {"liquid", "solid"}) {
        double before = 0.0;
        for (const double error : {1e-1, 1e-2, 1e-3}) {
            Setup setup = fallingBlock(*materialPreset(preset));
            setup.error = error;
            const auto count = static_cast<double>(afterFrames(setup, 12).steps.count);
            INFO(preset << ", error " << error << ", " << count << " steps");
            // Order 2: ten times less error takes three times the steps, less where frames limit them.
            CHECK(count > 1.5 * before);
            before = count;
        }
    }
}

TEST_CASE("The choice does not depend on threads", "[auto-stepper][threads]") {
    Setup setup = fallingBlock(*materialPreset("liquid"), {11, 10, 10});  // more than one chunk of a sum
    setup.error = 30.0;                                        // any value does; with this one few steps are enough
    const auto begin = [&] { return afterFrames(setup, 8); };  // the first twin and what it has taught
    const Simulation expected = begin();
    CHECK(expected.automatic.twinCount >= 1);
    for (const std::size_t threads : {1U, 2U, 8U}) {
        Simulation simulation;
        clouds::onThreads(threads, [&] { simulation = begin(); });
        CHECK(simulation.stepper == expected.stepper);
        CHECK(stateHash(simulation.particles) == stateHash(expected.particles));
        CHECK(simulation.automatic.largestError == expected.automatic.largestError);
        for (std::size_t s = 0; s < expected.automatic.controls.size(); ++s) {
            CHECK(simulation.automatic.controls[s].step == expected.automatic.controls[s].step);
            CHECK(simulation.automatic.controls[s].calibration == expected.automatic.controls[s].calibration);
        }
    }
}

TEST_CASE("An empty scene and one that fills later run automatically", "[auto-stepper]") {
    Setup setup = runs::freeSetup(*materialPreset("liquid"), StepperKind::automatic, 0.01);
    CHECK(afterFrames(setup, 3).time == 3 / 30.0);
    Emitter emitter;
    emitter.sites = {Vec3::Zero()};
    emitter.velocity = Vec3(0, 6, 0);
    emitter.start = 0.11;
    setup.emitters = {emitter};
    const Simulation simulation = afterFrames(setup, 9);  // 0.3 s, with emissions at 0.11 and 0.21 s
    REQUIRE(simulation.particles.count() == 2);
    // Nothing acts on them until they are 0.6 m apart, which they are.
    CHECK(simulation.particles.position[0].y() == Approx(6 * 0.19).epsilon(1e-12));  // roundings of some dozen steps
    CHECK(simulation.automatic.intervalCount > 0);
}
