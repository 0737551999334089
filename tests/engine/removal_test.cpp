// Removal of particles that leave a bounded world: which ones, when, and that the others go on unchanged.
#include "tests/catch.h"

#include "engine/error_control/error_estimate.h"
#include "engine/run/checkpoint.h"
#include "engine/run/diagnostics.h"
#include "engine/state/emitter_sites.h"
#include "tests/engine/runs.h"

using namespace engine;

namespace {

/// A jet that falls on a floor; the world ends where the floor ends.
Setup overflowing(StepperKind stepper) {
    Setup setup = runs::freeSetup(*materialPreset("liquid"), stepper, 0.004);
    setup.gravity = Vec3(0.0, -9.8, 0.0);
    setup.obstacles.shapes = {Plane{Vec3(0.0, 0.0, 0.0), Vec3::UnitY()}};
    Emitter emitter;
    emitter.sites = discSites(Vec3(0.0, 1.5, 0.0), Vec3(1.0, -1.0, 0.0), 0.5, 0.3);
    emitter.velocity = Vec3(4.0, -4.0, 0.0);
    emitter.interval = 0.06;
    setup.emitters = {emitter};
    setup.world = BoundingBox::unbounded();
    setup.world->high.x() = 2.5;
    return setup;
}

}  // namespace

TEST_CASE("Particles beyond the bounds are removed at the next interval; the others keep order and ids", "[removal]") {
    Setup setup = runs::freeSetup(*materialPreset("liquid"), StepperKind::velocityVerlet, 0.01);
    for (const double x : {-3.0, 2.0, 3.0, 4.0, 2.0 + 1e-12}) append(setup.initial, {.position = Vec3(x, x, 0.0)});
    setup.world = BoundingBox::unbounded();
    setup.world->high = Vec3(3.5, 2.0, 1.0);  // faces belong to the world
    Simulation simulation = start(setup);
    CHECK(simulation.particles.count() == 5);
    advance(simulation, runs::kFrame);
    CHECK(simulation.particles.id == std::vector<std::uint32_t>{0, 1});
    CHECK(simulation.removedCount == 3);
    append(simulation.particles, {.position = Vec3(-9.0, 0.0, 0.0)});
    CHECK(simulation.particles.id.back() == 5);  // ids are not used again
    truncate(simulation.particles, 2);
    append(simulation.particles, {.position = Vec3(-9.0, 0.0, 0.0)});
    CHECK(simulation.particles.id.back() == 5);
}

TEST_CASE("The other particles go on as if the removed ones had never been there", "[removal]") {
    for (const StepperKind stepper : kSteppers) {
        Setup alone = runs::freeSetup(*materialPreset("liquid"), stepper, 0.004);
        runs::addPacking(alone, {4, 4, 4});
        Setup accompanied = alone;
        append(accompanied.initial, {.position = Vec3(0.1, 50.0, 0.0), .radius = alone.initial.radius[0]});
        accompanied.world = BoundingBox{Vec3::Constant(-40.0), Vec3::Constant(40.0)};
        Simulation expected = start(alone);
        Simulation actual = start(accompanied);
        advance(expected, 3.0 * runs::kFrame);
        advance(actual, 3.0 * runs::kFrame);
        INFO(nameOf(stepper));
        CHECK(stateHash(actual.particles) == stateHash(expected.particles));
    }
}

TEST_CASE("A world without particles stays without particles", "[removal]") {
    Setup setup = overflowing(StepperKind::automatic);
    setup.emitters[0].limit = 3;
    setup.world->high.y() = -1.0;
    Simulation simulation = start(setup);
    runs::advanceFrames(simulation, 0, 10);
    CHECK(simulation.particles.count() == 0);
    CHECK(simulation.removedCount == 3);
    CHECK(largestCount(simulation) >= 1);
}

TEST_CASE("Emitted and removed particles account for all, and none stays outside for longer than a frame",
          "[removal]") {
    for (const StepperKind stepper : kSteppers) {
        Simulation simulation = start(overflowing(stepper));
        std::size_t most = 0;
        for (int frame = 0; frame < 45; ++frame) {
            runs::advanceFrames(simulation, frame, frame + 1);
            most = std::max(most, simulation.particles.count());
        }
        INFO(nameOf(stepper));
        CHECK(simulation.removedCount > 20);
        CHECK(simulation.particles.count() + simulation.removedCount == birthCount(simulation));
        CHECK(largestCount(simulation) == most);
        for (const Vec3& position : simulation.particles.position)
            CHECK(position.x() < 2.5 + 10.0 * runs::kFrame);  // nothing moves at 10 m/s
    }
}

TEST_CASE("Removal keeps a run's bits for any number of threads and after a resume", "[removal][threads]") {
    for (const StepperKind stepper : kSteppers) {
        const Setup setup = overflowing(stepper);
        Simulation whole = start(setup);
        runs::advanceFrames(whole, 0, 36);
        REQUIRE(whole.removedCount > 0);
        const std::vector<std::uint8_t> checkpoint = encodeCheckpoint(whole);
        runs::advanceFrames(whole, 36, 42);
        INFO(nameOf(stepper));
        Simulation resumed = decodeCheckpoint(setup, checkpoint);
        runs::advanceFrames(resumed, 36, 42);
        CHECK(encodeCheckpoint(resumed) == encodeCheckpoint(whole));
        clouds::onThreads(3, [&] {
            Simulation other = start(setup);
            runs::advanceFrames(other, 0, 42);
            CHECK(encodeCheckpoint(other) == encodeCheckpoint(whole));
        });
    }
}

TEST_CASE("Both runs of an error estimate keep all particles, also those beyond the bounds", "[removal]") {
    for (const StepperKind stepper : kSteppers) {
        if (stepper == StepperKind::automatic) continue;
        Simulation bounded = start(overflowing(stepper));
        runs::advanceFrames(bounded, 0, 36);
        bounded.setup.world->high.x() = bounded.particles.position[0].x() - 0.1;
        Simulation boundless = bounded;
        boundless.setup.world.reset();
        const TrialRun look{.time = bounded.time + runs::kFrame, .stepper = stepper, .step = 0.004};
        INFO(nameOf(stepper));
        CHECK(measure(bounded, look).error == measure(boundless, look).error);
    }
}

TEST_CASE("A checkpoint with impossible numbers of removed particles is refused", "[removal]") {
    const Setup setup = overflowing(StepperKind::velocityVerlet);
    Simulation simulation = start(setup);
    runs::advanceFrames(simulation, 0, 36);
    REQUIRE(simulation.removedCount > 0);
    const auto isTaken = [&](const Setup& by, const auto& change) {
        Simulation other = simulation;
        change(other);
        try {
            decodeCheckpoint(by, encodeCheckpoint(other));
        } catch (const CheckpointError&) {
            return false;
        }
        return true;
    };
    CHECK(isTaken(setup, [](Simulation&) {}));
    CHECK_FALSE(isTaken(setup, [](Simulation& s) { ++s.removedCount; }));
    CHECK_FALSE(isTaken(setup, [](Simulation& s) { s.largestCountBeforeRemoval = birthCount(s) + 1; }));
    CHECK_FALSE(isTaken(setup, [](Simulation& s) { s.largestCountBeforeRemoval = 0; }));
    CHECK_FALSE(isTaken(setup, [](Simulation& s) { ++s.particles.nextId; }));
    CHECK_FALSE(isTaken(setup, [](Simulation& s) { std::swap(s.particles.id[0], s.particles.id[1]); }));
    Setup boundless = setup;
    boundless.world.reset();
    CHECK_FALSE(isTaken(boundless, [](Simulation&) {}));
}

TEST_CASE("A world that has emptied takes steps, emissions and checkpoints like one that was empty from the start",
          "[removal]") {
    for (const StepperKind stepper :
         {StepperKind::velocityVerlet, StepperKind::implicitDamping, StepperKind::automatic}) {
        Setup setup = runs::freeSetup(*materialPreset("honey"), stepper, 0.004);
        setup.gravity = Vec3(0.0, -9.8, 0.0);
        setup.obstacles.shapes = {Plane{Vec3(0.0, -50.0, 0.0), Vec3::UnitY()}};
        runs::addPacking(setup, {2, 2, 2});
        setup.world = BoundingBox::unbounded();
        setup.world->low.y() = -0.5;
        Emitter emitter;
        emitter.sites = discSites(Vec3(0.0, 1.5, 0.0), Vec3::UnitY(), 0.4, 0.25);
        emitter.start = 0.62;
        emitter.interval = 0.05;
        emitter.clearance = 0.0;
        emitter.jitter = 0.3;
        setup.emitters = {emitter};
        Simulation whole = start(setup);
        int frame = 0;
        while (whole.particles.count() > 0 && frame < 18) advance(whole, ++frame * runs::kFrame);
        INFO(nameOf(stepper));
        REQUIRE(whole.particles.count() == 0);
        Simulation resumed = decodeCheckpoint(setup, encodeCheckpoint(whole));
        Simulation copied = whole;
        for (Simulation* simulation : {&whole, &resumed, &copied}) runs::advanceFrames(*simulation, frame, 24);
        REQUIRE(whole.particles.count() > 10);
        CHECK(stateHash(resumed.particles) == stateHash(whole.particles));
        CHECK(stateHash(copied.particles) == stateHash(whole.particles));
    }
}
