// Fields: closed forms under every stepper, their work in the audit, boxes and times, and the same bits after a resume
// and on several ranks.
#include "engine/state/fields.h"

#include <cmath>
#include <complex>
#include "tests/catch.h"

#include "engine/core/hash.h"
#include "engine/run/advance.h"
#include "engine/run/checkpoint.h"
#include "engine/run/diagnostics.h"
#include "engine/run/redistribution.h"
#include "engine/stepping/step_cache.h"
#include "tests/engine/runs.h"
#include "tests/engine/thread_ranks.h"

using namespace engine;

namespace {

/// One particle without gravity in a field.
Setup oneIn(const Field& field, const Vec3& position, const Vec3& velocity, StepperKind stepper, double step) {
    Setup setup = runs::freeSetup(*materialPreset("liquid"), stepper, step);
    append(setup.initial, {.position = position, .velocity = velocity});
    setup.fields = {field};
    return setup;
}

Simulation endOf(const Setup& setup, double time) {
    Simulation simulation = start(setup);
    advance(simulation, time);
    return simulation;
}

void checkNear(const Vec3& found, const Vec3& expected, double tolerance) {
    INFO("found " << found.transpose() << ", expected " << expected.transpose());
    CHECK((found - expected).norm() <= tolerance);
}

/// Wind in a box, an attraction, a stirrer for some time and a push in a scene of everything.
Setup busyInFields(StepperKind stepper) {
    Setup setup = runs::busyScene(stepper);
    setup.fields = {{.law = FlowField{.rate = 3.0, .velocity = Vec3(2, 0, 1)},
                     .box = BoundingBox{Vec3(-5, 1.2, -5), Vec3(5, 9, 5)}},
                    {.law = PointField{.center = Vec3(0, 2, 0), .strength = 3.0, .softening = 0.5}},
                    {.law = FlowField{.rate = 1.0, .spin = Vec3(0, 6, 0)}, .start = 0.021, .until = 0.077},
                    {.law = UniformField{Vec3(0, 0, 1.5)}}};
    return setup;
}

std::string hashOf(const std::vector<std::uint8_t>& checkpoint) {
    return hexadecimal(fnv1aOf(checkpoint));
}

constexpr int kFrames = 4;

std::string endAlone(const Setup& setup) {
    Simulation simulation = start(setup);
    runs::advanceFrames(simulation, 0, kFrames);
    return hashOf(encodeCheckpoint(simulation));
}

}  // namespace

TEST_CASE("A particle in a uniform field is a projectile", "[fields]") {
    const Field field{.law = UniformField{Vec3(1, -5, 2)}};
    const Vec3 velocity(0.5, 3, -1);
    for (const StepperKind stepper : kSteppers) {
        INFO(nameOf(stepper));
        const Simulation end = endOf(oneIn(field, Vec3(1, 2, 3), velocity, stepper, 0.01), 0.5);
        // The kicks of a constant acceleration are exact; a few hundred roundings of numbers below 10.
        checkNear(end.particles.position[0], Vec3(1, 2, 3) + 0.5 * velocity + 0.125 * Vec3(1, -5, 2), 1e-12);
        checkNear(end.particles.velocity[0], velocity + 0.5 * Vec3(1, -5, 2), 1e-12);
        CHECK(end.steps.rejected == 0);
    }
}

TEST_CASE("A field acts for its time, wherever steps end", "[fields]") {
    const Field field{.law = UniformField{Vec3(4, 0, 0)}, .start = 0.0123, .until = 0.0456};
    for (const StepperKind stepper : kSteppers) {
        INFO(nameOf(stepper));
        const Simulation end = endOf(oneIn(field, Vec3::Zero(), Vec3::Zero(), stepper, 0.01), 0.1);
        checkNear(end.particles.velocity[0], Vec3(4.0 * (0.0456 - 0.0123), 0, 0), 1e-15);
    }
}

TEST_CASE("Drag approaches the velocity of the wind exponentially", "[fields]") {
    const Vec3 wind(2, 0.5, 0);
    const Vec3 velocity(-1, 3, 1);
    const double rate = 1.7;
    for (const StepperKind stepper : kSteppers) {
        INFO(nameOf(stepper));
        const Field field{.law = FlowField{.rate = rate, .velocity = wind}};
        const Simulation end = endOf(oneIn(field, Vec3::Zero(), velocity, stepper, 0.001), 1.0);
        const Vec3 expected = wind + std::exp(-rate) * (velocity - wind);
        checkNear(end.particles.velocity[0], expected, 1e-12);  // the decay of each step is exact; a thousand roundings
        // x = w t + (v - w) (1 - exp(-k t)) / k; the splitting's error is (k h)^2 / 24 of it, the auto stepper's
        // larger.
        const Vec3 way = wind + (1.0 - std::exp(-rate)) / rate * (velocity - wind);
        checkNear(end.particles.position[0], way, stepper == StepperKind::automatic ? 1e-2 : 2e-6);
    }
}

TEST_CASE("A particle that falls in drag reaches its terminal velocity", "[fields]") {
    const Vec3 wind(1, 0, 0);
    const double rate = 20.0;
    for (const StepperKind stepper : {StepperKind::symplecticEuler, StepperKind::velocityVerlet, StepperKind::leapfrog,
                                      StepperKind::implicitDamping}) {
        INFO(nameOf(stepper));
        Setup setup =
            oneIn({.law = FlowField{.rate = rate, .velocity = wind}}, Vec3::Zero(), Vec3::Zero(), stepper, 1e-4);
        setup.gravity = Vec3(0, -9.8, 0);
        const Simulation end = endOf(setup, 1.0);
        // exp(-20) = 2e-9 is left of the approach, and (k h)^2 / 24 = 2e-7 is the splitting's share.
        checkNear(end.particles.velocity[0], wind + setup.gravity / rate, 1e-6);
    }
}

TEST_CASE("An orbit in a point field has its closed form and keeps its energy", "[fields]") {
    const PointField point{.center = Vec3(1, 0, 0), .strength = 12.0, .softening = 0.5};
    const double radius = 1.5;
    // The centripetal acceleration w^2 r is that of the field.
    const double soft = radius * radius + 0.25;
    const double angular = std::sqrt(12.0 / (soft * std::sqrt(soft)));
    const double quarter = 0.5 * std::acos(-1.0) / angular;
    double errorBefore = 0.0;
    for (const double step : {0.01, 0.005}) {
        Setup setup = oneIn({.law = point}, Vec3(1 + radius, 0, 0), Vec3(0, angular * radius, 0),
                            StepperKind::velocityVerlet, step);
        Simulation simulation = start(setup);
        const double before = energy(simulation).total();
        CHECK(energy(simulation).fields == Approx(-12.0 / std::sqrt(soft) * simulation.particles.mass[0]));
        advance(simulation, quarter);
        const double error = (simulation.particles.position[0] - Vec3(1, radius, 0)).norm();
        CHECK(error < step * step * angular * angular);
        if (errorBefore > 0.0) CHECK(errorBefore / error == Approx(4.0).epsilon(0.05));  // second order
        errorBefore = error;
        advance(simulation, 40.0 * quarter);
        // The energy of a symplectic step swings by a share (w h)^2 / 8 of the kinetic energy and does not drift.
        CHECK(std::abs(energy(simulation).total() - before) <
              0.125 * std::pow(angular * step, 2.0) * std::abs(energy(simulation).kinetic));
        CHECK(simulation.steps.rejected == 0);
    }
}

TEST_CASE("A vortex spins up a ring as its closed form says", "[fields]") {
    const double rate = 2.0;
    const double spin = 3.0;  // rad/s
    Setup setup = runs::freeSetup(*materialPreset("liquid"), StepperKind::velocityVerlet, 0.001);
    for (int k = 0; k < 6; ++k)
        append(setup.initial, {.position = Vec3(2.0 * std::cos(k), 0.1 * k, 2.0 * std::sin(k))});
    setup.fields = {{.law = FlowField{.rate = rate, .spin = Vec3(0, spin, 0)}}};
    const double time = 0.4;
    const Simulation end = endOf(setup, time);
    // With x + i z = u, a turn about y is u' = -i w u, and u'' = k (-i w u - u'). The roots are
    // q = (-k +- sqrt(k^2 - 4 i k w)) / 2; a start at rest has u(t) = (q2 exp(q1 t) - q1 exp(q2 t)) / (q2 - q1).
    using Complex = std::complex<double>;
    const Complex root = std::sqrt(Complex(rate * rate, -4.0 * rate * spin));
    const Complex one = 0.5 * (-rate + root);
    const Complex two = 0.5 * (-rate - root);
    const Complex turn = (two * std::exp(one * time) - one * std::exp(two * time)) / (two - one);
    for (std::size_t p = 0; p < 6; ++p) {
        const Vec3& from = setup.initial.position[p];
        const Complex to = turn * Complex(from.x(), from.z());
        checkNear(end.particles.position[p], Vec3(to.real(), from.y(), to.imag()), 1e-6);  // (w h)^2
        CHECK(from.cross(end.particles.velocity[p]).y() > 1.0);
    }
    CHECK(end.steps.rejected == 0);
}

TEST_CASE("A field with a box acts inside it only", "[fields]") {
    Setup setup = runs::freeSetup(*materialPreset("liquid"), StepperKind::velocityVerlet, 0.01);
    append(setup.initial, {.position = Vec3(-1, 0, 0), .velocity = Vec3(2, 0, 0)});
    append(setup.initial, {.position = Vec3(-1, 5, 0), .velocity = Vec3(2, 0, 0)});
    setup.fields = {{.law = UniformField{Vec3(0, 0, 3)}, .box = BoundingBox{Vec3(0, -1, -1), Vec3(1, 1, 1)}}};
    const Simulation end = endOf(setup, 2.0);
    // It flies through the box for half a second; kicks at both ends of a step know the passage to half a step each.
    CHECK(std::abs(end.particles.velocity[0].z() - 3.0 * 0.5) <= 3.0 * 0.01);
    CHECK(end.particles.velocity[1] == Vec3(2, 0, 0));
    CHECK(!setup.fields[0].isConservative());
    Simulation again = start(setup);
    CHECK(energy(again).fields == 0.0);
}

TEST_CASE("A field that is never there changes no bit", "[fields]") {
    for (const StepperKind stepper : kSteppers) {
        INFO(nameOf(stepper));
        Setup setup = runs::busyScene(stepper);
        const std::string without = endAlone(setup);
        setup.fields = {{.law = UniformField{Vec3(1, 1, 1)}, .start = 1e6}};
        CHECK(endAlone(setup) == without);
        setup.fields[0].start = 0.0;
        CHECK(endAlone(setup) != without);
    }
}

TEST_CASE("Damping in a wind keeps the order of velocity Verlet", "[fields]") {
    // Wind on half of a packing, which it presses against the other half; nothing crosses the border meanwhile.
    Setup setup = runs::freeSetup(runs::honey(), StepperKind::velocityVerlet, 0.01);
    runs::addPacking(setup, {4, 3, 3});
    setup.fields = {{.law = FlowField{.rate = 20.0, .velocity = Vec3(-40, 0, 0)},
                     .box = BoundingBox{Vec3(0, -9, -9), Vec3(9, 9, 9)}}};
    const double time = 0.02;
    const Particles fine = runs::afterSteps(setup, time, 8192).particles;
    const double coarse = runs::rmsDistance(runs::afterSteps(setup, time, 512).particles, fine);
    const double half = runs::rmsDistance(runs::afterSteps(setup, time, 1024).particles, fine);
    CAPTURE(coarse, half);
    CHECK(coarse / half > 3.5);  // 4 at second order, 2 at first
}

TEST_CASE("Steps in fields are accepted though fields do work", "[fields]") {
    for (const StepperKind stepper : kSteppers) {
        INFO(nameOf(stepper));
        Setup setup = busyInFields(stepper);
        Simulation with = start(setup);
        runs::advanceFrames(with, 0, kFrames);
        setup.fields.clear();
        Simulation without = start(setup);
        runs::advanceFrames(without, 0, kFrames);
        CHECK(with.steps.rejected <= without.steps.rejected + 4);
        CHECK(with.steps.count <= 2 * without.steps.count);
    }
}

TEST_CASE("Runs in fields go on from checkpoints with the same bits", "[fields]") {
    for (const StepperKind stepper : kSteppers) {
        INFO(nameOf(stepper));
        const Setup setup = busyInFields(stepper);
        const std::string expected = endAlone(setup);
        for (const int frame : {1, 2}) {
            Simulation half = start(setup);
            runs::advanceFrames(half, 0, frame);
            Simulation resumed = decodeCheckpoint(setup, encodeCheckpoint(half));
            runs::advanceFrames(resumed, frame, kFrames);
            CHECK(hashOf(encodeCheckpoint(resumed)) == expected);
        }
    }
}

TEST_CASE("Runs in fields have the same bits on several ranks", "[fields][ranks][threads]") {
    for (const StepperKind stepper : kSteppers) {
        INFO(nameOf(stepper));
        const Setup setup = busyInFields(stepper);
        std::string end;
        thread_ranks::onRanks(3, thread_ranks::slabs(3, 0.37), [&](const Ranks& ranks) {
            Simulation simulation = start(setup, ranks);
            for (int frame = 1; frame <= kFrames; ++frame) {
                advance(simulation, frame * runs::kFrame);
                if (frame % 2 == 0) redistribute(simulation);
            }
            const auto checkpoint = gatherCheckpoint(simulation);
            if (ranks.own() == 0) end = hashOf(checkpoint);
        });
        CHECK(end == endAlone(setup));
    }
}
