// The clearance that the drift assumes must never exceed the distance to the obstacles, or contacts would be left out.
#include "tests/catch.h"

#include "engine/error_control/checked_steps.h"
#include "engine/obstacles/swept_contact.h"
#include "engine/stepping/drift.h"
#include "engine/stepping/step_audit.h"
#include "tests/engine/runs.h"

using namespace engine;

namespace {

/// A packing that falls onto a slab over a floor, beside a ball, in a tank.
Simulation falling(StepperKind stepper, double step) {
    Setup setup = runs::freeSetup(*materialPreset("powder"), stepper, step);
    setup.gravity = Vec3(0.0, -9.81, 0.0);
    runs::addPacking(setup, {6, 6, 6});
    setup.obstacles.shapes = {
        Plane{Vec3(0.0, -2.5, 0.0), Vec3::UnitY()}, Box{Vec3(-1.0, -1.6, -1.0), Vec3(1.0, -1.3, 1.0)},
        Sphere{Vec3(1.6, -1.5, 0.3), 0.4, false}, Container{Vec3(-2.5, -4.0, -2.5), Vec3(2.5, 4.0, 2.5)}};
    return start(setup);
}

double gapOf(const Simulation& simulation, std::size_t p) {
    const Particles& particles = simulation.particles;
    return contactsInStep(simulation.setup.obstacles,
                          {.position = particles.position[p], .radius = particles.radius[p]}, 0.0, false)
        .gap;
}

struct Count {
    std::size_t clear = 0;     ///< particles known to touch no obstacle
    std::size_t touching = 0;  ///< those of them that do touch one
};

Count countIn(const Simulation& simulation) {
    Count count;
    for (std::size_t p = 0; p < simulation.particles.count(); ++p) {
        if (!isClearOfObstacles(simulation, p)) continue;
        ++count.clear;
        count.touching += gapOf(simulation, p) < 0.0 ? 1U : 0U;
    }
    return count;
}

}  // namespace

TEST_CASE("A particle known to be clear of all obstacles touches none", "[clearance]") {
    for (const StepperKind stepper : {StepperKind::velocityVerlet, StepperKind::leapfrog, StepperKind::implicitDamping,
                                      StepperKind::linearlyImplicit}) {
        Simulation simulation = falling(stepper, 0.002);
        std::size_t clear = 0;
        for (int k = 0; k < 400; ++k) {
            takeStep(simulation, 0.002);
            const Count count = countIn(simulation);
            REQUIRE(count.touching == 0);
            clear += count.clear;
        }
        CHECK(clear > 400 * simulation.particles.count() / 4);  // the clearance saves most of the searches
    }
}

TEST_CASE("Rejected steps, and those of the paper's stepper, leave no clearance behind", "[clearance]") {
    Simulation simulation = falling(StepperKind::velocityVerlet, 0.002);
    for (int k = 0; k < 50; ++k) takeStep(simulation, 0.002);
    SavedState saved;
    save(simulation, saved);
    takeStep(simulation, 0.5);
    restore(simulation, saved);
    CHECK(countIn(simulation).clear == 0);
    takeStep(simulation, 0.002);
    REQUIRE(countIn(simulation).clear > 0);
    simulation.stepper = StepperKind::symplecticEuler;
    takeStep(simulation, 0.002);
    CHECK(countIn(simulation).clear == 0);
}

TEST_CASE("A single particle at rest does not fall through a box in one long step", "[clearance]") {
    for (const StepperKind stepper : kSteppers) {
        if (stepper == StepperKind::symplecticEuler) continue;  // the paper's stepper rejects no step
        Setup setup = runs::freeSetup(*materialPreset("liquid"), stepper, 1.0);
        setup.gravity = Vec3(0.0, -9.8, 0.0);
        setup.obstacles.shapes = {Box{Vec3(-5.0, -0.5, -5.0), Vec3(5.0, 0.0, 5.0)}};
        const double radius = setup.materials[0].radius;
        append(setup.initial,
               {.position = Vec3(0.0, radius + 0.05, 0.0), .radius = radius, .mass = setup.materials[0].mass});
        Simulation simulation = start(setup);
        advance(simulation, 1.0);
        INFO(nameOf(stepper));
        CHECK(simulation.particles.position[0].y() > 0.0);
    }
}
