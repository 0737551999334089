// Runs with heat: the sum of all energies stays, bodies melt and set, and states have the same bits everywhere.
#include "tests/catch.h"

#include <cmath>
#include <numeric>

#include "engine/core/hash.h"
#include "engine/run/advance.h"
#include "engine/run/checkpoint.h"
#include "engine/run/diagnostics.h"
#include "engine/run/redistribution.h"
#include "engine/stepping/step_cache.h"
#include "tests/engine/on_instruction_set.h"
#include "tests/engine/runs.h"
#include "tests/engine/thread_ranks.h"

#include <tbb/global_control.h>

using namespace engine;

namespace {

constexpr double kFrame = 0.03;  // s

/// A stiff solid that melts at 350 K into something soft and thin.
Material wax() {
    Material wax = *materialPreset("solid");
    wax.radius = 0.05;
    wax.mass = 0.1;
    wax.repulsion = 1e-4;
    wax.damping = 4.0;
    wax.friction = 0.3;
    wax.thermal = {.capacity = 100.0, .conductivity = 40.0, .melting = 350.0, .latent = 1000.0};
    return wax;
}

Material moltenWax() {
    Material melt = wax();
    melt.repulsion = 2e-5;
    melt.damping = 0.4;
    melt.repulsionReach = 1.0;
    melt.friction = 0.0;
    melt.cohesion = 0.4;
    melt.agitation = 0.05;
    return melt;
}

/// A melting material and its stages. Particles get a temperature (K), which does not melt them.
void addHeat(Setup& setup, double temperature, double plate) {
    setup.materials = {wax()};
    const std::vector<Material> stages = stagesOf(wax(), moltenWax(), 16);
    setup.materials.insert(setup.materials.end(), stages.begin(), stages.end());
    setup.heat.emplace();
    setup.heat->interval = kFrame / 2.0;
    setup.heat->melts = {{0, 1, 16}};
    setup.heat->obstacles = {plate};
    for (std::size_t p = 0; p < setup.initial.count(); ++p) {
        setup.initial.mass[p] = wax().mass;
        setup.initial.enthalpy.push_back(wax().mass * enthalpyAt(wax().thermal, temperature));
    }
}

/// A block that falls a little, onto a plate.
Setup blockOnPlate(StepperKind stepper, double temperature, double plate) {
    Setup setup;
    setup.stepper = stepper;
    setup.step = 0.002;
    setup.obstacles.wall = WallLaw::scaled;
    setup.obstacles.gravity = 9.8;
    setup.obstacles.shapes = {Plane{}};
    const Material material = wax();
    for (const Vec3& position :
         gridPositions(Vec3(0, 0.15, 0), {5, 5, 5}, {.spacing = 1.9 * material.radius, .jitter = 0.05}))
        append(setup.initial, {.position = position, .radius = material.radius, .mass = material.mass});
    addHeat(setup, temperature, plate);
    return setup;
}

double heatOf(const Simulation& simulation) {
    const std::vector<double>& enthalpy = simulation.particles.enthalpy;
    return std::accumulate(enthalpy.begin(), enthalpy.end(), 0.0);
}

double meanShare(const Simulation& simulation) {
    double sum = 0.0;
    const Particles& particles = simulation.particles;
    for (std::size_t p = 0; p < particles.count(); ++p)
        sum += meltedShare(wax().thermal, particles.enthalpy[p] / particles.mass[p]);
    return sum / static_cast<double>(particles.count());
}

void advanceFrames(Simulation& simulation, int from, int to) {
    for (int frame = from + 1; frame <= to; ++frame) advance(simulation, frame * kFrame);
}

std::string hashOf(const std::vector<std::uint8_t>& checkpoint) {
    return hexadecimal(fnv1aOf(checkpoint));
}

}  // namespace

TEST_CASE("Stages go from the solid to the melt, by equal factors or differences", "[heat]") {
    const std::vector<Material> stages = stagesOf(wax(), moltenWax(), 16);
    REQUIRE(stages.size() == 16);
    for (std::size_t k = 0; k < stages.size(); ++k) {
        const double share = static_cast<double>(k + 1) / 16.0;
        CHECK(stages[k].repulsion == Approx(1e-4 * std::pow(0.2, share)).epsilon(1e-12));
        CHECK(stages[k].damping == Approx(4.0 * std::pow(0.1, share)).epsilon(1e-12));
        CHECK(stages[k].friction == Approx(0.3 * (1.0 - share)).margin(1e-15));
        CHECK(stages[k].cohesion == Approx(0.4 * share));
        CHECK(stages[k].agitation == Approx(0.05 * share));
        CHECK(stages[k].thermal == wax().thermal);
    }
    CHECK(stages.back().repulsion == moltenWax().repulsion);
    CHECK(stages.back().friction == 0.0);
    const Melt melt{2, 5, 16};
    CHECK(stageAt(melt, 0.0) == 2);
    CHECK(stageAt(melt, 0.03) == 2);
    CHECK(stageAt(melt, 0.04) == 5);
    CHECK(stageAt(melt, 1.0) == 20);
    CHECK(isStage(melt, 2));
    CHECK(isStage(melt, 20));
    CHECK_FALSE(isStage(melt, 4));
    CHECK_FALSE(isStage(melt, 21));
}

TEST_CASE("A block on a hot plate melts from below, and sets on a cold one", "[heat][threads]") {
    Setup setup = blockOnPlate(StepperKind::velocityVerlet, 345.0, 450.0);
    Simulation simulation = start(setup);
    advanceFrames(simulation, 0, 60);
    double lowest = 0.0;
    double highest = 0.0;
    for (std::size_t p = 0; p < simulation.particles.count(); ++p) {
        const double share = meltedShare(wax().thermal, simulation.particles.enthalpy[p] / wax().mass);
        CHECK(simulation.particles.material[p] == stageAt(setup.heat->melts[0], share));
        (simulation.particles.position[p].y() < 0.12 ? lowest : highest) += share;
    }
    CHECK(lowest > 10.0 * highest);
    CHECK(meanShare(simulation) > 0.1);
    CHECK(simulation.heat.received > 0.0);
    Simulation cooled = simulation;
    cooled.setup.heat->obstacles = {300.0};
    advanceFrames(cooled, 60, 300);
    CHECK(meanShare(cooled) < 0.3 * meanShare(simulation));
    CHECK(cooled.heat.received < simulation.heat.received);
}

TEST_CASE("Kinetic, potential and thermal energy together are constant in a closed box", "[heat]") {
    // An explicit exchange, and implicit ones; all stages are passed.
    for (const StepperKind stepper :
         {StepperKind::velocityVerlet, StepperKind::linearlyImplicit, StepperKind::automatic}) {
        INFO(nameOf(stepper));
        Setup setup = blockOnPlate(stepper, 340.0, 300.0);
        setup.heat->obstacles.clear();
        for (std::size_t p = 0; p < setup.initial.count(); p += 2) setup.initial.enthalpy[p] *= 1.2;
        Simulation simulation = start(setup);
        const double before = energy(simulation).total() + heatOf(simulation);
        const double mechanical = energy(simulation).total();
        advanceFrames(simulation, 0, 30);
        CHECK(meanShare(simulation) > 0.05);
        CHECK(simulation.heat.ofMelting != 0.0);
        const double lost = mechanical - energy(simulation).total();
        CHECK(lost > 1.0);
        CHECK(simulation.heat.damped == Approx(lost + simulation.heat.ofMelting).epsilon(1e-9));
        // Of the energy that became heat, a hundred-millionth may be lost by rounding the far larger heat.
        const double after = energy(simulation).total() + heatOf(simulation) + simulation.heat.pending;
        CHECK(std::abs(after - before) < 1e-8 * lost);
        CHECK(simulation.heat.pending < 0.1 * lost);
    }
}

TEST_CASE("The heat of damping stays with those that are damped", "[heat]") {
    // Two pairs far apart, one of which collides.
    Setup setup = runs::freeSetup(wax(), StepperKind::velocityVerlet, 0.001);
    runs::addPair(setup, 0.11, 1.0);
    append(setup.initial, {.position = Vec3(5, 0, 0), .radius = 0.05, .mass = wax().mass});
    addHeat(setup, 300.0, 300.0);
    Simulation simulation = start(setup);
    advanceFrames(simulation, 0, 4);
    const std::vector<double>& enthalpy = simulation.particles.enthalpy;
    const double cold = wax().mass * enthalpyAt(wax().thermal, 300.0);
    CHECK(enthalpy[0] > cold);
    CHECK(enthalpy[0] == Approx(enthalpy[1]).epsilon(1e-14));
    CHECK(enthalpy[2] == cold);
    const double given = simulation.heat.damped - simulation.heat.pending;
    CHECK(given > 0.5 * simulation.heat.damped);
    CHECK(enthalpy[0] + enthalpy[1] - 2.0 * cold == Approx(given).epsilon(1e-6));
}

TEST_CASE("A run with heat has the same bits on every instruction set", "[heat]") {
    // At the higher conductivity the exchanges are implicit.
    for (const double conductivity : {40.0, 4000.0})
        for (const StepperKind stepper : {StepperKind::velocityVerlet, StepperKind::automatic})
            for (const Precision precision : {Precision::doubles, Precision::singles}) {
                Setup setup = blockOnPlate(stepper, 349.0, 500.0);
                setup.precision = precision;
                for (Material& material : setup.materials) material.thermal.conductivity = conductivity;
                std::string expected;
                for (const std::string& name : instructionSets()) {
                    INFO(name << ", " << nameOf(stepper) << ", precision " << static_cast<int>(precision));
                    const OnInstructionSet on(name);
                    Simulation simulation = start(setup);
                    advanceFrames(simulation, 0, 8);
                    CHECK(meanShare(simulation) > 0.01);
                    const std::string hash = hashOf(encodeCheckpoint(simulation));
                    if (expected.empty()) expected = hash;
                    CHECK(hash == expected);
                }
            }
}

TEST_CASE("A run with heat has the same bits on any threads, ranks and after a resume", "[heat]") {
    for (const StepperKind stepper :
         {StepperKind::symplecticEuler, StepperKind::leapfrog, StepperKind::linearlyImplicit, StepperKind::automatic})
        for (const Precision precision : {Precision::doubles, Precision::singles}) {
            INFO(nameOf(stepper) << ", precision " << static_cast<int>(precision));
            Setup setup = blockOnPlate(stepper, 349.0, 500.0);
            setup.precision = precision;
            Emitter emitter;
            emitter.sites = {Vec3(0, 1, 0)};
            emitter.velocity = Vec3(0, -3, 0);
            emitter.interval = 0.1;
            emitter.temperature = 360.0;
            setup.emitters = {emitter};
            constexpr int kFrames = 16;
            Simulation simulation = start(setup);
            advanceFrames(simulation, 0, kFrames);
            CHECK(simulation.heat.exchangeCount == 2 * kFrames);
            CHECK(meanShare(simulation) > 0.01);
            CHECK(simulation.particles.material.back() == 16);  // emitted as a melt
            const std::string expected = hashOf(encodeCheckpoint(simulation));
            {
                const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
                Simulation again = start(setup);
                advanceFrames(again, 0, kFrames);
                CHECK(hashOf(encodeCheckpoint(again)) == expected);
            }
            Simulation half = start(setup);
            advanceFrames(half, 0, kFrames / 2);
            Simulation resumed = decodeCheckpoint(setup, encodeCheckpoint(half));
            advanceFrames(resumed, kFrames / 2, kFrames);
            CHECK(hashOf(encodeCheckpoint(resumed)) == expected);
            std::string onRanks;
            thread_ranks::onRanks(3, thread_ranks::slabs(3, 0.17), [&](const Ranks& ranks) {
                Simulation part = start(setup, ranks);
                for (int frame = 1; frame <= kFrames; ++frame) {
                    advance(part, frame * kFrame);
                    if (frame % 4 == 0) redistribute(part);
                }
                const auto checkpoint = gatherCheckpoint(part);
                if (ranks.own() == 0) onRanks = hashOf(checkpoint);
            });
            CHECK(onRanks == expected);
        }
}

TEST_CASE("A checkpoint of a run with heat is refused where it has none", "[heat][threads]") {
    Setup setup = blockOnPlate(StepperKind::velocityVerlet, 345.0, 450.0);
    Simulation simulation = start(setup);
    advanceFrames(simulation, 0, 1);
    const auto bytes = encodeCheckpoint(simulation);
    Setup without = setup;
    without.heat.reset();
    without.initial.enthalpy.clear();
    CHECK_THROWS_AS(decodeCheckpoint(without, bytes), CheckpointError);
    CHECK_NOTHROW(decodeCheckpoint(setup, bytes));
}
