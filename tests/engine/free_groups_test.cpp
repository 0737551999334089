// Strays, particles in free fall far from all others, cost the others no steps, follow their parabola, and do not hide
// what goes wrong elsewhere.
#include "engine/stepping/free_groups.h"

#include <cmath>
#include "tests/catch.h"

#include "engine/run/diagnostics.h"
#include "engine/stepping/step_audit.h"
#include "tests/engine/runs.h"

using namespace engine;

namespace {

constexpr double kRun = 0.5;  // s

/// A block that falls on a table.
Setup block(StepperKind stepper) {
    Material solid = *materialPreset("solid");
    solid.mass = 0.1;
    Setup setup = runs::freeSetup(solid, stepper, 1.0 / 480);
    setup.gravity = Vec3(0, -9.8, 0);
    setup.error = 0.05;
    setup.obstacles.shapes = {Box{Vec3(-3, -1.7, -3), Vec3(3, -0.7, 3)}};
    runs::addPacking(setup, {4, 4, 4});
    return setup;
}

/// Adds a clump of four particles at their rest distances, and a single particle, both far below the table.
void addStrays(Setup& setup) {
    const double radius = setup.materials[0].radius;
    const auto add = [&](const Vec3& position, const Vec3& velocity) {
        append(setup.initial,
               {.position = position, .velocity = velocity, .radius = radius, .mass = setup.materials[0].mass});
    };
    for (const Vec3& corner : {Vec3(1, 1, 1), Vec3(1, -1, -1), Vec3(-1, 1, -1), Vec3(-1, -1, 1)})
        add(Vec3(3, -2000, 0) + radius / std::sqrt(2.0) * corner, Vec3(0, -200, 0));
    add(Vec3(-100, -5000, 50), Vec3(-30, -300, 0));
}

Simulation run(const Setup& setup) {
    Simulation simulation = start(setup);
    runs::advanceFrames(simulation, 0, static_cast<int>(kRun / runs::kFrame));
    return simulation;
}

/// RMS distance of the block's particles, the first ones, in two runs, m.
double blockDistance(const Simulation& a, const Simulation& b) {
    Particles one = a.particles;
    Particles other = b.particles;
    truncate(one, 64);
    truncate(other, 64);
    return runs::rmsDistance(one, other);
}

/// Where gravity carries the center of some particles of a set-up, and where it is in a run, m.
double offParabola(const Setup& setup, const Simulation& simulation, std::size_t first, std::size_t count) {
    const double t = simulation.time;
    Vec3 apart = Vec3::Zero();
    for (std::size_t p = first; p < first + count; ++p)
        apart += simulation.particles.position[p] - setup.initial.position[p] - t * setup.initial.velocity[p] -
                 0.5 * t * t * setup.gravity;
    return apart.norm() / static_cast<double>(count);
}

}  // namespace

TEST_CASE("Strays cost no steps and follow their parabola", "[free-groups]") {
    Setup fine = block(StepperKind::velocityVerlet);
    addStrays(fine);
    fine.step = 1.0 / 15360;
    const Simulation reference = run(fine);
    CHECK(offParabola(fine, reference, 64, 4) < 1e-7);  // 2000 m are rounded by 2e-13 m in each of 7680 steps
    for (const StepperKind stepper :
         {StepperKind::velocityVerlet, StepperKind::leapfrog, StepperKind::linearlyImplicit, StepperKind::automatic}) {
        Setup setup = block(stepper);
        const Simulation without = run(setup);
        addStrays(setup);
        const Simulation with = run(setup);
        INFO(nameOf(stepper) << ": " << with.steps.count << " steps, without strays " << without.steps.count);
        CHECK(static_cast<double>(with.steps.count) <= 1.2 * static_cast<double>(without.steps.count));
        // The block is as near to the run with small steps as it is without strays, up to the wanted error. The factor
        // is chosen: the last bits decide in which frames the automatic stepper estimates errors.
        const double wanted = setup.error * kRun * setup.materials[0].radius;
        CHECK(blockDistance(with, reference) <= wanted + 2.0 * blockDistance(without, reference));
        CHECK(offParabola(setup, with, 64, 4) < 1e-9);  // roundings as above, in some hundred steps
        CHECK(offParabola(setup, with, 68, 1) < 1e-9);  // same
    }
}

TEST_CASE("Strays that drag slows down cost no steps either", "[free-groups]") {
    Setup setup = block(StepperKind::automatic);
    setup.drag = 0.5;
    setup.error = 0.005;  // small enough that the error limits the steps, and velocity Verlet takes them all
    const auto stepsOf = [](const Setup& of) {
        Simulation simulation = start(of);
        runs::advanceFrames(simulation, 0, 90);
        CHECK(simulation.stepper == StepperKind::velocityVerlet);
        return static_cast<double>(simulation.steps.count);
    };
    const double without = stepsOf(setup);
    addStrays(setup);
    CHECK(stepsOf(setup) <= 1.2 * without);
}

TEST_CASE("Strays that meet something within an interval take the steps of any particles", "[free-groups]") {
    Setup setup = runs::freeSetup(*materialPreset("liquid"), StepperKind::velocityVerlet, 1e-3);
    append(setup.initial, {.position = Vec3(0, 0, 0)});
    append(setup.initial, {.position = Vec3(0, 100, 0), .velocity = Vec3(0, -110, 0)});
    const auto run = [&](int intervals) {
        Simulation simulation = start(setup);
        for (int k = 1; k <= intervals; ++k) advance(simulation, static_cast<double>(k) / intervals);
        return simulation;
    };
    const Simulation whole = run(1);
    const Simulation parts = run(1000);  // whose groups are found anew just before the particles meet
    CHECK(static_cast<double>(whole.steps.count) < 1.2 * static_cast<double>(parts.steps.count));
    for (std::size_t p = 0; p < 2; ++p)
        CHECK((whole.particles.position[p] - parts.particles.position[p]).norm() < 1e-3);
}

TEST_CASE("A long step of strays that meet something is rejected", "[free-groups]") {
    Setup setup = runs::freeSetup(*materialPreset("liquid"), StepperKind::velocityVerlet, 1.0);
    append(setup.initial, {.position = Vec3(0, 0, 0)});
    append(setup.initial, {.position = Vec3(0, 100, 0), .velocity = Vec3(0, -110, 0)});
    const auto rejection = [](const Setup& of) {
        Simulation simulation = start(of);
        SavedState saved;
        save(simulation, saved);
        takeStep(simulation, 1.0);
        return rejectionReason(simulation, saved);
    };
    CHECK(rejection(setup) == StepLimit::displacement);  // through the other particle
    setup.initial.velocity[1].y() = 50.0;
    CHECK_FALSE(rejection(setup));
    setup.obstacles.shapes = {Box{Vec3(-1, 120, -1), Vec3(1, 121, 1)}};
    CHECK(rejection(setup) == StepLimit::displacement);  // through the box
    setup.obstacles.shapes = {Box{Vec3(-1, 160, -1), Vec3(1, 161, 1)}};
    CHECK_FALSE(rejection(setup));
}

TEST_CASE("The energy of a stray does not hide what a step gains elsewhere", "[free-groups]") {
    for (const StepperKind stepper : {StepperKind::velocityVerlet, StepperKind::leapfrog, StepperKind::implicitDamping,
                                      StepperKind::linearlyImplicit}) {
        Setup setup = block(stepper);
        addStrays(setup);
        Simulation simulation = start(setup);
        advance(simulation, runs::kFrame);
        SavedState saved;
        save(simulation, saved);
        REQUIRE(saved.allowance > 10.0);  // J; a thousandth of the kinetic energy
        takeStep(simulation, 1e-4);
        INFO(nameOf(stepper));
        CHECK_FALSE(rejectionReason(simulation, saved));
        *simulation.cache->energy += 1.0;
        CHECK(rejectionReason(simulation, saved) == StepLimit::audit);
    }
}
