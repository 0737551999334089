// Runs that several ranks share: the same bits as in one process, for any stepper, number of ranks and division of the
// particles, through emissions, removals, redistributions and checkpoints.
#include "engine/ranks/ranks.h"

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
using thread_ranks::onRanks;
using thread_ranks::Owner;

namespace {

/// The busy scene with a nozzle that keeps room, and a clump far away that leaves the world.
Setup busy(StepperKind stepper) {
    Setup setup = runs::busyScene(stepper);
    for (int k = 0; k < 3; ++k)
        append(setup.initial, {.position = Vec3(-40.5, 30.0 + 0.2 * k, 0.1 * k), .velocity = Vec3(-30, 0, 0)});
    setup.world = BoundingBox{Vec3(-41, -50, -50), Vec3(50, 50, 50)};
    Emitter& emitter = setup.emitters.front();
    emitter.interval = 0.05;
    emitter.pick = Pick::random;
    emitter.leastDelay = 0.01;
    return setup;
}

/// Grains of three materials and very different sizes, with friction.
Setup mixed(StepperKind stepper) {
    Setup setup;
    setup.materials.clear();
    for (const char* const name : {"sand", "mud", "liquid"}) setup.materials.push_back(*materialPreset(name));
    setup.materials[0].friction = 0.3;
    setup.stepper = stepper;
    setup.step = 0.001;
    setup.initial = clouds::strewnUnequal(300, 1.0);
    for (std::size_t p = 0; p < setup.initial.count(); ++p) {
        setup.initial.material[p] = static_cast<std::uint32_t>(p % 3);
        if (p % 7 == 0) setup.initial.radius[p] *= 0.2;
        if (p % 150 == 0) setup.initial.radius[p] *= 4.0;
    }
    setup.obstacles.shapes = {Plane{Vec3(0, -1.5, 0), Vec3::UnitY()}};
    return setup;
}

/// The busy scene with a paddle that spins in it.
Setup stirred(StepperKind stepper) {
    Setup setup = busy(stepper);
    Obstacles& obstacles = setup.obstacles;
    obstacles.wall = WallLaw::scaled;
    obstacles.motions.resize(obstacles.shapes.size());
    obstacles.shapes.emplace_back(Box{Vec3(-1.0, 0.1, -0.1), Vec3(1.0, 0.5, 0.1)});
    Motion& paddle = obstacles.motions.emplace_back();
    paddle.pivot = Vec3(0, 0.3, 0);
    paddle.spin = Vec3(0, 8, 0);
    return setup;
}

constexpr double kFrameTime = 0.03;  // s

/// Enough for the automatic stepper to compare a run with twins, and few for the others.
int frameCount(const Setup& setup) {
    return setup.stepper == StepperKind::automatic && !setup.emitters.empty() ? 32 : 4;
}

std::string hashOfCheckpoint(const std::vector<std::uint8_t>& checkpoint) {
    return hexadecimal(fnv1aOf(checkpoint));
}

/// The hash at the end of a run in one process.
std::string endAlone(const Setup& setup) {
    Simulation simulation = start(setup);
    for (int frame = 1; frame <= frameCount(setup); ++frame) advance(simulation, frame * kFrameTime);
    CHECK(simulation.particles.count() > 100);
    if (!setup.emitters.empty()) {
        CHECK(birthCount(simulation) > 1);
        CHECK(simulation.removedCount == 3);
        if (setup.stepper == StepperKind::automatic) CHECK(simulation.automatic.twinCount > 1);
    }
    return hashOfCheckpoint(encodeCheckpoint(simulation));
}

/// The hash at the end of the same run on some ranks, which exchange particles after every other frame.
std::string endOnRanks(const Setup& setup, int count, const Owner& owner) {
    std::string end;
    std::string gathered;
    std::string inCheckpoint;
    onRanks(count, owner, [&](const Ranks& ranks) {
        Simulation simulation = start(setup, ranks);
        for (int frame = 1; frame <= frameCount(setup); ++frame) {
            advance(simulation, frame * kFrameTime);
            if (frame % 2 == 0) redistribute(simulation);
        }
        const auto checkpoint = gatherCheckpoint(simulation);
        Simulation whole = start(setup);
        gather(simulation, whole);
        if (ranks.own() != 0) return;
        end = hashOfCheckpoint(checkpoint);
        gathered = stateHash(whole.particles);
        inCheckpoint = stateHash(decodeCheckpoint(setup, checkpoint).particles);
    });
    CHECK(gathered == inCheckpoint);
    return end;
}

void checkDivisions(const Setup& setup) {
    const std::string expected = endAlone(setup);
    for (const int count : {2, 3}) {
        INFO(count << " ranks");
        CHECK(endOnRanks(setup, count, thread_ranks::slabs(count, 0.37)) == expected);
        CHECK(endOnRanks(setup, count, thread_ranks::scattered(count)) == expected);
    }
    CHECK(endOnRanks(setup, 4, [](const Vec3&) { return 2; }) == expected);  // all on one of them
}

}  // namespace

TEST_CASE("A run on several ranks ends in the state of a run in one process", "[ranks][threads]") {
    for (const StepperKind stepper : kSteppers) {
        INFO(nameOf(stepper));
        checkDivisions(busy(stepper));
    }
}

TEST_CASE("What a paddle stirs, and its loads, have the same bits on any ranks", "[ranks]") {
    for (const StepperKind stepper :
         {StepperKind::symplecticEuler, StepperKind::linearlyImplicit, StepperKind::automatic}) {
        INFO(nameOf(stepper));
        Simulation simulation = start(stirred(stepper));
        advance(simulation, 2.0 * kFrameTime);
        CHECK(simulation.loads.back().work != 0.0);
        checkDivisions(stirred(stepper));
    }
}

TEST_CASE("Mixtures of many sizes have the same bits on any ranks, in both precisions", "[ranks]") {
    for (const StepperKind stepper : {StepperKind::symplecticEuler, StepperKind::automatic})
        for (const Precision precision : {Precision::doubles, Precision::singles}) {
            INFO(nameOf(stepper) << ", precision " << static_cast<int>(precision));
            Setup setup = mixed(stepper);
            setup.precision = precision;
            checkDivisions(setup);
        }
}

TEST_CASE("A run goes on from a checkpoint on any number of ranks", "[ranks][threads]") {
    for (const StepperKind stepper : {StepperKind::symplecticEuler, StepperKind::leapfrog, StepperKind::automatic}) {
        INFO(nameOf(stepper));
        const Setup setup = busy(stepper);
        const std::string expected = endAlone(setup);
        Simulation half = start(setup);
        for (int frame = 1; frame <= frameCount(setup) / 2; ++frame) advance(half, frame * kFrameTime);
        const std::vector<std::uint8_t> middle = encodeCheckpoint(half);
        std::string end;
        onRanks(3, thread_ranks::slabs(3, 0.21), [&](const Ranks& ranks) {
            Simulation simulation = ranks.own() == 0 ? decodeCheckpoint(setup, middle) : start(setup, Ranks::alone());
            divide(simulation, ranks);
            for (int frame = frameCount(setup) / 2 + 1; frame <= frameCount(setup); ++frame)
                advance(simulation, frame * kFrameTime);
            const auto checkpoint = gatherCheckpoint(simulation);
            if (ranks.own() == 0) end = hashOfCheckpoint(checkpoint);
        });
        CHECK(end == expected);
    }
}

TEST_CASE("An unstable run ends on all ranks with the message of a run in one process", "[ranks][threads]") {
    Setup setup = busy(StepperKind::symplecticEuler);
    setup.materials[0].damping = 1e9;
    setup.initial.velocity[17] = Vec3(1e30, 0, 0);
    std::string expected;
    try {
        Simulation simulation = start(setup);
        advance(simulation, 1.0);
    } catch (const InstabilityError& error) {
        expected = error.what();
    }
    CHECK(expected.find("became unstable: particle") != std::string::npos);
    std::vector<std::string> texts(3);
    onRanks(3, thread_ranks::scattered(3), [&](const Ranks& ranks) {
        try {
            Simulation simulation = start(setup, ranks);
            advance(simulation, 1.0);
        } catch (const InstabilityError& error) {
            texts[static_cast<std::size_t>(ranks.own())] = error.what();
        }
    });
    for (const std::string& text : texts) CHECK(text == expected);
}
