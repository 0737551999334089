// Emitters in motion: where they emit is a function of time alone, and particles get the emitter's own velocity.
#include "engine/state/emission.h"

#include <cmath>
#include <limits>
#include <numbers>
#include "tests/catch.h"

#include "engine/core/hash.h"
#include "engine/core/sine.h"
#include "engine/run/advance.h"
#include "engine/run/checkpoint.h"
#include "engine/run/redistribution.h"
#include "engine/run/strays.h"
#include "engine/state/emitter_sites.h"
#include "tests/engine/runs.h"
#include "tests/engine/thread_ranks.h"

using namespace engine;

namespace {

constexpr double kRadius = 0.15;  // of the default material, m

/// A point that emits a particle every tenth of a second.
Setup nozzleAt(const Vec3& position, const Vec3& velocity, const Motion& motion) {
    Setup setup;
    setup.gravity = Vec3(0, -9.8, 0);
    Emitter emitter;
    emitter.sites = {position};
    emitter.velocity = velocity;
    emitter.motion = motion;
    setup.emitters = {emitter};
    return setup;
}

/// The particle of an emission at a time, which was due `late` seconds before.
NewParticle particleAt(const Setup& setup, double time, double late) {
    std::vector<NewParticle> particles;
    drawEmission(setup, {}, time, late, particles);
    REQUIRE(particles.size() == 1);
    return particles.front();
}

void checkClose(const Vec3& found, const Vec3& expected, double tolerance) {
    INFO("found " << found.transpose() << ", expected " << expected.transpose());
    CHECK((found - expected).norm() <= tolerance);
}

/// A packing under a nozzle that turns and glides, and that has to wait for room now and then.
Setup busyWithMotion(StepperKind stepper) {
    Setup setup = runs::busyScene(stepper);
    Emitter& emitter = setup.emitters.front();
    emitter.interval = 0.05;
    emitter.pick = Pick::staggered;
    emitter.motion.pivot = Vec3(2, 1, 0);
    emitter.motion.keys = {{0.01, Vec3(2, 1, 0), Vec3::Zero()},
                           {0.07, Vec3(1.4, 1.2, 0.3), Vec3(12, -29, 17)},
                           {0.11, Vec3(1.4, 1.6, 0.3), Vec3(23, -29, 6)}};
    completeTimes(emitter, setup.gravity, kRadius);
    return setup;
}

std::string endOf(const Setup& setup, int frames) {
    Simulation simulation = start(setup);
    runs::advanceFrames(simulation, 0, frames);
    CHECK(birthCount(simulation) > 3);
    return hexadecimal(fnv1aOf(encodeCheckpoint(simulation)));
}

}  // namespace

TEST_CASE("An emitter that travels gives its particles its own velocity", "[emitters]") {
    const Vec3 position(1, 2, 3);
    const Vec3 velocity(0, -3, 0.5);
    const Vec3 travel(2, 0.25, -1);
    const Setup setup = nozzleAt(position, velocity, {.pivot = position, .velocity = travel});
    for (const double time : {0.0, 0.3, 2.0})
        for (const double late : {0.0, 0.004}) {
            const double born = time - late;
            const NewParticle particle = particleAt(setup, time, late);
            checkClose(particle.velocity, velocity + travel + late * setup.gravity,
                       1e-14);  // a few roundings below 10
            checkClose(particle.position,
                       position + born * travel + late * (velocity + travel) + 0.5 * late * late * setup.gravity,
                       1e-14);
            CHECK(particle.birthTime == born);
        }
}

TEST_CASE("An emitter that turns throws its particles along the tangent, too", "[emitters]") {
    const Vec3 pivot(1, 0, 0);
    const double spin = 2.0 * std::numbers::pi * 0.75;  // rad/s about y
    const Setup setup = nozzleAt(pivot + Vec3(0.5, 0.2, 0), Vec3(2, 1, 0), {.pivot = pivot, .spin = Vec3(0, spin, 0)});
    for (const double time : {0.0, 0.1, 1.7}) {
        const double s = std::sin(spin * time);
        const double c = std::cos(spin * time);
        const NewParticle particle = particleAt(setup, time, 0.0);
        // A turn about y takes x to (cos, 0, -sin); the tangent there is (-sin, 0, -cos). A few roundings below 10.
        checkClose(particle.position, pivot + Vec3(0.5 * c, 0.2, -0.5 * s), 1e-14);
        checkClose(particle.velocity, Vec3(2.0 * c, 1, -2.0 * s) + 0.5 * spin * Vec3(-s, 0, -c), 2e-14);
    }
}

TEST_CASE("An emitter glides along its keys, and rests before and after them", "[emitters]") {
    const Vec3 from(0, 1, 0);
    const Vec3 to(3, 1, -1);
    Motion motion{.pivot = from};
    motion.keys = {{1.0, from, Vec3::Zero()}, {3.0, to, Vec3(0, 0, 90)}};
    const Setup setup = nozzleAt(from, Vec3(0, -2, 0), motion);
    checkClose(particleAt(setup, 0.5, 0.0).position, from, 1e-15);
    checkClose(particleAt(setup, 0.5, 0.0).velocity, Vec3(0, -2, 0), 1e-15);
    checkClose(particleAt(setup, 9.0, 0.0).position, to, 1e-15);
    checkClose(particleAt(setup, 9.0, 0.0).velocity, Vec3(2, 0, 0), 1e-15);
    // Between two keys at rest the path is the cubic 3 u^2 - 2 u^3, whose slope in the middle is 1.5.
    const NewParticle middle = particleAt(setup, 2.0, 0.0);
    const double half = 2.0 / std::sqrt(2.0);
    checkClose(middle.position, 0.5 * (from + to), 1e-14);
    checkClose(middle.velocity, Vec3(half, -half, 0) + 1.5 / 2.0 * (to - from), 1e-14);
}

TEST_CASE("A jet of an emitter that travels is the jet at rest, seen from elsewhere", "[emitters]") {
    const Vec3 travel(0.5, 0.25, -0.75);
    const auto endOfJet = [&](const Vec3& own) {
        Setup setup = nozzleAt(Vec3::Zero(), Vec3(0, 4, 0), {.velocity = own});
        Emitter& emitter = setup.emitters.front();
        emitter.sites = takingTurns(discSites(Vec3::Zero(), emitter.velocity, 2.0 * kRadius, 2.0 * kRadius));
        emitter.pick = Pick::staggered;
        emitter.spread = oneMinusCosine(8.0);
        setup.stepper = StepperKind::velocityVerlet;
        setup.step = 0.005;
        Simulation simulation = start(setup);
        runs::advanceFrames(simulation, 0, 12);
        return simulation;
    };
    const Simulation still = endOfJet(Vec3::Zero());
    const Simulation moving = endOfJet(travel);
    REQUIRE(still.particles.count() > 10);
    REQUIRE(moving.particles.count() == still.particles.count());
    for (std::size_t p = 0; p < still.particles.count(); ++p) {
        // Roundings of positions below 10 grow a little where particles push one another.
        checkClose(moving.particles.position[p], still.particles.position[p] + still.time * travel, 1e-12);
        checkClose(moving.particles.velocity[p], still.particles.velocity[p] + travel, 1e-11);
    }
}

TEST_CASE("A wait for room moves an emission to where its emitter is then", "[emitters]") {
    Setup setup = nozzleAt(Vec3::Zero(), Vec3::Zero(), {.velocity = Vec3(1, 0, 0)});
    setup.gravity = Vec3::Zero();
    setup.emitters[0].limit = 1;
    append(setup.initial, {.position = Vec3(-0.2, 0, 0)});  // the emitter is a diameter away after 0.1 s
    Simulation simulation = start(setup);
    CHECK(birthCount(simulation) == 0);
    advance(simulation, 0.5);
    REQUIRE(simulation.particles.count() == 2);
    const double born = simulation.particles.birthTime[1];
    CHECK(born >= 0.1 - 1e-9);
    CHECK(born <= 0.1 + retryDelay(setup.emitters[0]));
    CHECK(simulation.particles.position[1].x() > born + 0.3);  // it goes on with its emitter, a little damped
}

TEST_CASE("Runs with an emitter in motion go on from checkpoints with the same bits", "[emitters]") {
    for (const StepperKind stepper : {StepperKind::symplecticEuler, StepperKind::velocityVerlet}) {
        const Setup setup = busyWithMotion(stepper);
        const std::string expected = endOf(setup, 5);
        Simulation half = start(setup);
        runs::advanceFrames(half, 0, 2);
        Simulation resumed = decodeCheckpoint(setup, encodeCheckpoint(half));
        runs::advanceFrames(resumed, 2, 5);
        CHECK(hexadecimal(fnv1aOf(encodeCheckpoint(resumed))) == expected);
        Setup atRest = setup;
        atRest.emitters[0].motion = {};
        CHECK(endOf(atRest, 5) != expected);
    }
}

TEST_CASE("Runs with an emitter in motion have the same bits on several ranks", "[emitters][ranks][threads]") {
    const Setup setup = busyWithMotion(StepperKind::velocityVerlet);
    const std::string expected = endOf(setup, 5);
    std::string end;
    thread_ranks::onRanks(3, thread_ranks::slabs(3, 0.37), [&](const Ranks& ranks) {
        Simulation simulation = start(setup, ranks);
        for (int frame = 1; frame <= 5; ++frame) {
            advance(simulation, frame * runs::kFrame);
            if (frame % 2 == 0) redistribute(simulation);
        }
        const auto checkpoint = gatherCheckpoint(simulation);
        if (ranks.own() == 0) end = hexadecimal(fnv1aOf(checkpoint));
    });
    CHECK(end == expected);
}

TEST_CASE("The groups of a jet from a fast emitter fly freely over no more than a layer", "[emitters]") {
    Emitter emitter;
    emitter.velocity = Vec3(0, -1, 0);
    emitter.sites = takingTurns(discSites(Vec3::Zero(), emitter.velocity, 4.0 * kRadius, 2.0 * kRadius));
    emitter.interval = 0.1;
    emitter.pick = Pick::staggered;
    completeTimes(emitter, Vec3::Zero(), kRadius);
    const double atRest = emitter.grouping;
    emitter.motion.velocity = Vec3(6, 0, 0);
    completeTimes(emitter, Vec3::Zero(), kRadius);
    CHECK(atRest > 0.0);
    CHECK(emitter.grouping < atRest);
    CHECK(emitter.grouping * 7.0 <= 2.2 * kRadius * 1.001);  // 2.2 radii, at the sum of both speeds at most
}

TEST_CASE("Particles of an emitter that has travelled far are no strays", "[emitters]") {
    Setup setup = nozzleAt(Vec3::Zero(), Vec3(1, 0, 0), {.velocity = Vec3(20, 0, 0)});
    setup.gravity = Vec3::Zero();
    Simulation simulation = start(setup);
    simulation.time = 10.0;
    append(simulation.particles, particleAt(setup, 10.0, 0.0));
    CHECK(strayCount(simulation) == 0);
    simulation.setup.emitters[0].motion = {};
    CHECK(strayCount(simulation) == 1);
}
