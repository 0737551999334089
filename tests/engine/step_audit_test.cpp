// The audit: steps that gain energy are rejected completely, with the emissions since, and a run that no shorter step
// can save says so.
#include "engine/stepping/step_audit.h"

#include <algorithm>
#include "tests/catch.h"

#include "engine/run/diagnostics.h"
#include "engine/state/emitter_sites.h"
#include "engine/stepping/step_cache.h"
#include "tests/engine/runs.h"

using namespace engine;

namespace {

constexpr std::array kAudited = {StepperKind::velocityVerlet, StepperKind::leapfrog, StepperKind::implicitDamping,
                                 StepperKind::linearlyImplicit};

/// A cubic lattice of stiff particles pressed to two thirds of their rest length.
Setup pressedLattice(StepperKind stepper, const char* preset, double step) {
    Material material = *materialPreset(preset);
    material.repulsion = 80.0;
    Setup setup = runs::freeSetup(material, stepper, step);
    for (const Vec3& position : gridPositions(Vec3::Zero(), {4, 4, 4}, {.spacing = 0.2, .jitter = 0.05}))
        append(setup.initial, {.position = position});
    return setup;
}

/// A nozzle over a floor with a stiff block in its way: emissions between steps of which many are rejected.
Setup busyNozzle(StepperKind stepper) {
    Setup setup = pressedLattice(stepper, "solid", 0.02);
    setup.gravity = Vec3(0, -9.8, 0);
    setup.drag = 0.1;
    setup.obstacles.shapes = {Plane{Vec3(0, -1, 0), Vec3::UnitY()}};
    Emitter emitter;
    emitter.sites = discSites(Vec3(3, 1, 0), Vec3(-6, 1, 0), 0.3, 0.3);
    emitter.velocity = Vec3(-6, 1, 0);
    emitter.interval = 0.06;
    setup.emitters = {emitter};
    return setup;
}

/// Energy of the state, computed from every pair, and the sum of the magnitudes of its terms.
struct Fresh {
    double total = 0.0;  ///< J
    double size = 0.0;   ///< J
};

Fresh freshEnergy(const Simulation& simulation) {
    ForceEvaluator evaluator(simulation.cache->evaluator.forceField(), ForceMethod::reference);
    const Energy parts = energy(evaluator, simulation.particles);
    return {parts.total(), parts.kinetic + std::abs(parts.pairs) + std::abs(parts.contacts) + std::abs(parts.gravity)};
}

}  // namespace

TEST_CASE("A step that gains energy is rejected, and restoring leaves nothing of it", "[step-audit]") {
    for (const StepperKind stepper : {StepperKind::velocityVerlet, StepperKind::implicitDamping}) {
        Simulation simulation = start(pressedLattice(stepper, "solid", 1e-5));
        advance(simulation, 2e-3);
        const std::string before = stateHash(simulation.particles);
        const double energyBefore = *simulation.cache->energy;
        SavedState saved;
        save(simulation, saved);
        takeStep(simulation, 1e-5);
        CHECK_FALSE(rejectionReason(simulation, saved));
        const std::string good = stateHash(simulation.particles);
        restore(simulation, saved);
        takeStep(simulation, 0.02);
        CHECK(rejectionReason(simulation, saved));
        const StepStatistics spent = simulation.steps;
        restore(simulation, saved);
        CHECK(stateHash(simulation.particles) == before);
        CHECK(*simulation.cache->energy == energyBefore);
        // What a rejected step has cost stays counted.
        CHECK(spent.forceEvaluations > saved.steps.forceEvaluations);
        CHECK(simulation.steps.forceEvaluations == spent.forceEvaluations);
        CHECK(spent.matrices == saved.steps.matrices + (isVerlet(stepper) ? 0 : 2));
        CHECK(simulation.steps.matrices == spent.matrices);
        CHECK(simulation.steps.products == spent.products);
        takeStep(simulation, 1e-5);
        CHECK(stateHash(simulation.particles) == good);
    }
}

TEST_CASE("A step further than a radius is rejected where there is anything to miss", "[step-audit]") {
    for (const double distance : {0.149, 0.151}) {
        Setup setup = runs::freeSetup(*materialPreset("liquid"), StepperKind::velocityVerlet, 1.0);
        append(setup.initial, {.velocity = Vec3(distance, 0, 0)});
        append(setup.initial, {.position = Vec3(0, 5, 0)});
        Simulation simulation = start(setup);
        SavedState saved;
        save(simulation, saved);
        takeStep(simulation, 1.0);
        CHECK((rejectionReason(simulation, saved) == StepLimit::displacement) == (distance > 0.15));
    }
    Setup alone = runs::freeSetup(*materialPreset("liquid"), StepperKind::velocityVerlet, 1.0);
    append(alone.initial, {.velocity = Vec3(100, 0, 0)});
    Simulation simulation = start(alone);
    advance(simulation, 1.0);
    CHECK(simulation.steps.count == 1);
    CHECK(simulation.steps.rejected == 0);
}

TEST_CASE("A stiff lattice that is not relaxed stays finite, and its energy within the allowance", "[step-audit]") {
    for (const StepperKind stepper : kAudited)
        for (const char* preset : {"solid", "powder"}) {
            Simulation simulation = start(pressedLattice(stepper, preset, 1.0 / 30));
            double before = freshEnergy(simulation).total;
            const double atStart = before;
            for (int interval = 0; interval < 100; ++interval) {
                const double allowedBefore = energyAllowance(simulation);
                const std::uint64_t stepsBefore = simulation.steps.count;
                advance(simulation, simulation.time + std::min(1.0 / 30, simulation.restriction.seconds));
                const Fresh now = freshEnergy(simulation);
                const auto steps = static_cast<double>(simulation.steps.count - stepsBefore);
                // Each step may gain its allowance, which changes little over the one to few steps of an interval.
                const double allowed = steps * std::max(allowedBefore, energyAllowance(simulation));
                INFO(nameOf(stepper) << ", " << preset << ", " << simulation.time << " s, " << steps << " steps");
                CHECK(now.total <= before + allowed + 1e-13 * now.size);  // and the rounding of two sums
                before = now.total;
            }
            CHECK(simulation.steps.rejected > 0);
            CHECK(before < atStart);
        }
}

TEST_CASE("A step that was too long for honey can be rejected and shortened", "[step-audit]") {
    // At 1/240 s the damping turns velocities round, and the mean velocities in the middle of a step hide how fast its
    // end is.
    for (const StepperKind stepper : {StepperKind::implicitDamping, StepperKind::linearlyImplicit})
        for (const double step : {1.0 / 60, 1.0 / 120, 1.0 / 240, 1.0 / 480}) {
            Setup setup = runs::freeSetup(runs::honey(), stepper, step);
            setup.gravity = Vec3(0, -9.8, 0);
            setup.obstacles.shapes = {Plane{Vec3(0, -0.7, 0), Vec3::UnitY()}};
            runs::addPacking(setup, {4, 4, 4});
            Simulation simulation = start(setup);
            const double before = freshEnergy(simulation).total;
            INFO(nameOf(stepper) << " at " << step << " s");
            REQUIRE_NOTHROW(advance(simulation, 0.1));
            CHECK(freshEnergy(simulation).total < before);
        }
}

TEST_CASE("Steps grow again when the cause of short ones is over", "[step-audit]") {
    for (const StepperKind stepper : kAudited) {
        Material material = *materialPreset("powder");
        material.repulsion = 80.0;
        material.mass = 0.1;
        Setup setup = runs::freeSetup(material, stepper, 1.0 / 60);
        runs::addPair(setup, 0.31, 1.0);
        Simulation simulation = start(setup);
        for (int frame = 1; frame <= 60; ++frame) advance(simulation, frame / 30.0);
        CHECK(simulation.steps.rejected > 0);
        const std::uint64_t before = simulation.steps.count;
        advance(simulation, 61 / 30.0);
        INFO(nameOf(stepper));
        CHECK(simulation.steps.count == before + 2);  // a frame at the set-up's step
    }
}

TEST_CASE("The recorded energy is that of the state, emissions included", "[step-audit]") {
    for (const StepperKind stepper : kAudited) {
        Simulation simulation = start(busyNozzle(stepper));
        const std::size_t bodies = simulation.setup.initial.count();
        for (int frame = 1; frame <= 10; ++frame) {
            advance(simulation, 0.03 * frame);
            const Fresh fresh = freshEnergy(simulation);
            INFO(nameOf(stepper) << " at frame " << frame);
            CHECK(std::abs(*simulation.cache->energy - fresh.total) <=
                  1e-12 * fresh.size);  // two orders of 5000 roundings
        }
        CHECK(simulation.particles.count() > bodies + 20);
    }
}

TEST_CASE("No emission is lost with rejected steps", "[step-audit]") {
    for (const StepperKind stepper : kAudited) {
        Simulation simulation = start(busyNozzle(stepper));
        const std::size_t bodies = simulation.setup.initial.count();
        for (int frame = 1; frame <= 10; ++frame) advance(simulation, 0.03 * frame);
        CHECK(simulation.steps.rejected > 0);
        CHECK(simulation.time == 0.03 * 10);
        REQUIRE(simulation.particles.count() == bodies + birthCount(simulation));
        for (std::size_t p = 0; p < simulation.particles.count(); ++p) CHECK(simulation.particles.id[p] == p);
        for (const Schedule& schedule : simulation.emitters[0].schedules) {
            CHECK(schedule.births > 0);
            CHECK((schedule.delayed || schedule.due > simulation.time));  // no emission is forgotten
        }
    }
}

TEST_CASE("Restoring a state before an emission undoes it, and it happens again with the same bits", "[step-audit]") {
    Simulation simulation = start(busyNozzle(StepperKind::velocityVerlet));
    advance(simulation, 0.05);
    SavedState saved;
    save(simulation, saved);
    const Simulation before = simulation;
    advance(simulation, 0.07);
    CHECK(birthCount(simulation) > birthCount(before));
    restore(simulation, saved);
    CHECK(simulation.time == before.time);
    CHECK(stateHash(simulation.particles) == stateHash(before.particles));
    CHECK(birthCount(simulation) == birthCount(before));
    CHECK(refusalCount(simulation) == refusalCount(before));
    for (std::size_t s = 0; s < simulation.emitters[0].schedules.size(); ++s)
        CHECK(simulation.emitters[0].schedules[s].due == before.emitters[0].schedules[s].due);
    Simulation again = before;
    advance(again, 0.07);
    simulation.restriction = before.restriction;
    simulation.cache->evaluator =
        before.cache->evaluator;  // the list, which orders sums and finds neighbors, is not part of the saved state
    advance(simulation, 0.07);
    CHECK(stateHash(simulation.particles) == stateHash(again.particles));
}

TEST_CASE("A run that no step can save names the particle, the time and what to change", "[step-audit]") {
    for (const StepperKind stepper : kAudited) {
        Setup setup = runs::freeSetup(*materialPreset("liquid"), stepper, 0.01);
        append(setup.initial, {.position = Vec3(0, 5, 0)});
        append(setup.initial, {.velocity = Vec3(1e13, 0, 0)});  // a radius in 1.5e-14 s
        Simulation simulation = start(setup);
        try {
            advance(simulation, 0.01);
            FAIL("a particle of 1e13 m/s was let pass by " << nameOf(stepper));
        } catch (const InstabilityError& error) {
            INFO(error.what());
            for (const char* part : {"particle 1 ", "1e+13 m/s", "time 0 ", "step ", "physics.step"})
                CHECK(std::string(error.what()).find(part) != std::string::npos);
        }
    }
}

TEST_CASE("A rejected step leaves no cached neighbors, which a resumed run would not have", "[audit]") {
    Setup setup = runs::freeSetup(*materialPreset("liquid"), StepperKind::velocityVerlet, 0.001);
    runs::addPacking(setup, {4, 4, 4});
    setup.obstacles.shapes = {Container{Vec3::Constant(-0.5), Vec3::Constant(0.5)}};
    Simulation simulation = start(setup);
    takeStep(simulation, 0.001);
    SavedState saved;
    save(simulation, saved);
    takeStep(simulation, 0.002);
    REQUIRE(std::ranges::any_of(simulation.cache->cachedNeighbors,
                                [&](std::uint32_t p) { return p < simulation.particles.count(); }));
    restore(simulation, saved);
    CHECK(simulation.cache->cachedNeighbors.empty());
    Simulation resumed = simulation;
    for (Simulation* either : {&simulation, &resumed}) takeStep(*either, 0.001);
    CHECK(simulation.particles.position == resumed.particles.position);
}

TEST_CASE("A particle with neighbors gets no swept contact because a rejected step led away from them",
          "[step-audit]") {
    for (const StepperKind stepper : kAudited) {
        Setup setup = runs::freeSetup(*materialPreset("liquid"), stepper, 0.01);
        setup.obstacles.shapes = {Plane{Vec3::Zero(), Vec3::UnitY()}};
        append(setup.initial, {.position = Vec3(0, 0.155, 0), .velocity = Vec3(0, -1, 0)});
        append(setup.initial, {.position = Vec3(0.3, 0.2, 0), .velocity = Vec3(10, 0, 0)});
        Simulation simulation = start(setup);
        takeStep(simulation, 1e-6);
        SavedState saved;
        save(simulation, saved);
        takeStep(simulation, 0.01);
        const std::string good = stateHash(simulation.particles);
        REQUIRE(simulation.cache->swept[0] == 0);
        restore(simulation, saved);
        takeStep(simulation, 0.1);  // they part, and a list of that state is built
        simulation.cache->evaluator.pairEnergyGrid(simulation.particles);
        restore(simulation, saved);
        takeStep(simulation, 0.01);
        INFO(nameOf(stepper));
        CHECK(simulation.cache->swept[0] == 0);
        CHECK(stateHash(simulation.particles) == good);
    }
}

TEST_CASE("Without a list for forces Verlet does not use one that another stepper has left", "[step-audit]") {
    Setup setup = runs::freeSetup(*materialPreset("liquid"), StepperKind::implicitDamping, 0.1);
    setup.forces = ForceMethod::reference;
    setup.obstacles.shapes = {Plane{}};
    append(setup.initial, {.position = Vec3(0, 1, 0)});
    append(setup.initial, {.position = Vec3(0.3, 1, 0), .velocity = Vec3(10, 0, 0)});
    Simulation simulation = start(setup);
    takeStep(simulation, 0.1);
    REQUIRE(simulation.cache->evaluator.list().count() == 2);
    simulation.stepper = StepperKind::velocityVerlet;
    takeStep(simulation, 0.1);
    CHECK_FALSE(simulation.cache->startIsListed);
}
