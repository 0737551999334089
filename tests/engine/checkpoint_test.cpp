// A run that is resumed from a checkpoint has the same bits as the run it was taken from; damaged bytes are refused.
#include "engine/run/checkpoint.h"
#include "engine/state/emitter_sites.h"
#include "engine/stepping/step_cache.h"

#include <cstring>
#include <limits>
#include <string>

#include "engine/core/hash.h"
#include "engine/run/diagnostics.h"
#include "tests/catch.h"
#include "tests/engine/runs.h"

namespace {

using engine::CheckpointError;
using engine::Setup;
using engine::Simulation;
using engine::StepperKind;
using engine::Vec3;

/// A block that falls on a floor and a sphere, under a nozzle whose emissions have to wait for room now and then.
Setup busySetup(StepperKind stepper) {
    engine::Material solid = *engine::materialPreset("solid");
    solid.mass = 0.1;
    Setup setup = runs::freeSetup(solid, stepper, 0.004);
    setup.gravity = Vec3(0.0, -9.8, 0.0);
    setup.drag = 0.1;
    setup.obstacles.shapes = {engine::Plane{Vec3(0, -0.6, 0), Vec3::UnitY()},
                              engine::Sphere{Vec3(0.4, -0.6, 0.4), 0.3}};
    setup.error = 0.05;
    runs::addPacking(setup, {5, 5, 5});
    engine::Emitter nozzle;
    nozzle.sites = engine::discSites(Vec3(0.5, 2.5, 0.5), Vec3(0, -1, 0), 0.4, 0.31);
    nozzle.velocity = Vec3(0, -3, 0);
    nozzle.interval = 0.07;
    nozzle.jitter = 0.1;
    setup.emitters = {nozzle};
    return setup;
}

/// Resumes from checkpoints at several frames, and compares everything that a checkpoint at the end holds.
void checkGoingOn(const Setup& setup, int frames) {
    Simulation whole = engine::start(setup);
    std::vector<std::vector<std::uint8_t>> checkpoints = {encodeCheckpoint(whole)};
    for (int frame = 1; frame <= frames; ++frame) {
        engine::advance(whole, frame * runs::kFrame);
        checkpoints.push_back(encodeCheckpoint(whole));
    }
    for (int frame = 0; frame <= frames; frame += 3) {
        INFO("from frame " << frame);
        Simulation resumed = decodeCheckpoint(setup, checkpoints[static_cast<std::size_t>(frame)]);
        CHECK(encodeCheckpoint(resumed) == checkpoints[static_cast<std::size_t>(frame)]);
        runs::advanceFrames(resumed, frame, frames);
        CHECK(engine::stateHash(resumed.particles) == engine::stateHash(whole.particles));
        CHECK(encodeCheckpoint(resumed) == checkpoints.back());
    }
}

std::vector<std::uint8_t> checkpointOf(const Setup& setup, int frames) {
    Simulation simulation = engine::start(setup);
    runs::advanceFrames(simulation, 0, frames);
    return encodeCheckpoint(simulation);
}

/// Corrects the checksum after the bytes were changed.
void sign(std::vector<std::uint8_t>& bytes) {
    const std::size_t size = bytes.size() - 8;
    const std::uint64_t checksum = engine::fnv1aOf(std::span(bytes).first(size));
    std::memcpy(bytes.data() + size, &checksum, 8);
}

/// Sets eight bytes from an offset on.
void fill(std::vector<std::uint8_t>& bytes, std::size_t at) {
    for (std::size_t byte = at; byte < at + 8; ++byte) bytes.at(byte) = 0xFF;
}

std::string complaint(const Setup& setup, const std::vector<std::uint8_t>& bytes) {
    try {
        engine::decodeCheckpoint(setup, bytes);
    } catch (const CheckpointError& error) {
        return error.what();
    }
    return "";
}

}  // namespace

TEST_CASE("A run goes on from a checkpoint with the same bits", "[checkpoint]") {
    const StepperKind stepper =
        GENERATE(StepperKind::symplecticEuler, StepperKind::velocityVerlet, StepperKind::leapfrog,
                 StepperKind::implicitDamping, StepperKind::linearlyImplicit, StepperKind::automatic);
    INFO(engine::nameOf(stepper));
    checkGoingOn(busySetup(stepper), 12);
}

TEST_CASE("A run in single precision goes on with the same bits", "[checkpoint]") {
    Setup setup = busySetup(StepperKind::velocityVerlet);
    setup.precision = engine::Precision::singles;
    checkGoingOn(setup, 12);
}

TEST_CASE("A run of two materials, with random emissions and friction, goes on with the same bits", "[checkpoint]") {
    Setup setup = busySetup(StepperKind::automatic);
    setup.materials.push_back(*engine::materialPreset("powder"));
    setup.materials.back().friction = 0.3;
    setup.emitters.front().material = 1;
    setup.emitters.front().pick = engine::Pick::random;
    setup.emitters.front().interval = 0.01;
    checkGoingOn(setup, 12);
}

TEST_CASE("A run with a staggered jet of drops goes on with the same bits", "[checkpoint]") {
    const StepperKind stepper =
        GENERATE(StepperKind::symplecticEuler, StepperKind::velocityVerlet, StepperKind::automatic);
    Setup setup = busySetup(stepper);
    engine::Emitter& nozzle = setup.emitters.front();
    nozzle.pick = engine::Pick::staggered;
    nozzle.spread = 0.1;
    nozzle.speedSpread = 0.1;
    nozzle.cluster = engine::clusterPositions(GENERATE(1U, 4U), 2.0 * setup.materials[0].radius);
    engine::completeTimes(nozzle, setup.gravity, setup.materials[0].radius);
    REQUIRE(nozzle.grouping > 0.0);
    checkGoingOn(setup, 12);
    Simulation whole = engine::start(setup);
    runs::advanceFrames(whole, 0, 12);
    CHECK(refusalCount(whole) > 0);
}

TEST_CASE("A run with strays goes on with the same bits", "[checkpoint]") {
    const StepperKind stepper =
        GENERATE(StepperKind::velocityVerlet, StepperKind::linearlyImplicit, StepperKind::automatic);
    Setup setup = busySetup(stepper);
    setup.obstacles.shapes.front() = engine::Box{Vec3(-2, -1.6, -2), Vec3(2, -0.6, 2)};
    append(setup.initial, {.position = Vec3(0, -300, 0), .velocity = Vec3(0, -200, 0), .radius = 0.15, .mass = 0.1});
    append(setup.initial, {.position = Vec3(0, -300.25, 0), .velocity = Vec3(0, -200, 0), .radius = 0.15, .mass = 0.1});
    setup.world = engine::BoundingBox::unbounded();
    setup.world->low.x() = -0.4;  // crosses the block, so that particles are removed
    checkGoingOn(setup, 12);
}

TEST_CASE("A run without particles goes on", "[checkpoint]") {
    Setup setup = busySetup(StepperKind::automatic);
    setup.initial = {};
    setup.emitters.front().start = 0.1;
    checkGoingOn(setup, 9);
}

TEST_CASE("Bytes that are not a checkpoint's are refused", "[checkpoint]") {
    const Setup setup = busySetup(StepperKind::velocityVerlet);
    const auto bytes = checkpointOf(setup, 3);
    REQUIRE(complaint(setup, bytes).empty());
    for (const std::size_t size : {std::size_t{0}, std::size_t{7}, std::size_t{100}, bytes.size() - 1}) {
        INFO("cut to " << size);
        CHECK_FALSE(complaint(setup, {bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size)}).empty());
    }
    for (std::size_t at = 0; at < bytes.size(); at += 97) {
        auto damaged = bytes;
        damaged[at] ^= 0x10;
        INFO("byte " << at);
        CHECK(complaint(setup, damaged).find("checksum") != std::string::npos);
    }
}

TEST_CASE("A checkpoint with a correct checksum and impossible contents is refused", "[checkpoint]") {
    const Setup setup = busySetup(StepperKind::velocityVerlet);
    const auto bytes = checkpointOf(setup, 3);
    auto other = bytes;
    other[0] ^= 1;  // the format
    sign(other);
    CHECK(complaint(setup, other).find("version") != std::string::npos);
    auto more = bytes;
    more.insert(more.end() - 8, 4, 0);
    sign(more);
    CHECK(complaint(setup, more).find("follows its end") != std::string::npos);
    auto shorter = bytes;
    shorter.erase(shorter.end() - 12, shorter.end() - 8);
    sign(shorter);
    CHECK(complaint(setup, shorter).find("truncated") != std::string::npos);
    auto endless = bytes;
    fill(endless, 16);  // the number of particles
    sign(endless);
    CHECK(complaint(setup, endless).find("truncated") != std::string::npos);
    auto nowhere = bytes;
    fill(nowhere, 24);  // the first coordinate becomes NaN
    sign(nowhere);
    CHECK(complaint(setup, nowhere).find("world") != std::string::npos);
}

TEST_CASE("A checkpoint of a state that no run leads to is refused", "[checkpoint]") {
    const Setup setup = busySetup(StepperKind::automatic);
    Simulation whole = engine::start(setup);
    runs::advanceFrames(whole, 0, 3);
    REQUIRE(birthCount(whole) > 0);
    REQUIRE(complaint(setup, encodeCheckpoint(whole)).empty());
    const auto complaintAfter = [&](const auto& change) {
        Simulation other = whole;
        change(other);
        return complaint(setup, encodeCheckpoint(other));
    };
    const double nan = std::numeric_limits<double>::quiet_NaN();

    const std::string particles = "its particles are not the scene's";
    CHECK(complaintAfter([](Simulation& s) { s.particles.radius.front() *= 1.001; }) == particles);
    CHECK(complaintAfter([](Simulation& s) { s.particles.mass.back() = 1e-20; }) == particles);
    CHECK(complaintAfter([](Simulation& s) { s.particles.material.back() = 1; }) == particles);
    CHECK(complaintAfter([](Simulation& s) { s.particles.id.back() = 0; }) == particles);
    CHECK(complaintAfter([](Simulation& s) {
              truncate(s.particles, s.particles.count() - 1);
              s.cache->forcesCurrent = false;
          }) == particles);

    const std::string schedule = "a birth is not on its schedule";
    CHECK(complaintAfter([](Simulation& s) { s.emitters[0].schedules[0].due = -1e300; }) == schedule);
    CHECK(complaintAfter([](Simulation& s) { s.emitters[0].schedules[0].due += 1e-6; }) == schedule);
    CHECK(complaintAfter([](Simulation& s) { s.emitters[0].schedules[0].origin = -1.0; }) == schedule);
    CHECK(complaintAfter([](Simulation& s) { s.time += 1.0; }) == schedule);
    CHECK(complaintAfter([](Simulation& s) { ++s.emitters[0].schedules[0].births; }) == schedule);

    const std::string steps = "the scene's stepper does not take its steps";
    CHECK(complaintAfter([](Simulation& s) { s.stepper = StepperKind::symplecticEuler; }) == steps);
    CHECK(complaintAfter([](Simulation& s) { s.restriction.seconds = 1e-300; }) == steps);
    CHECK(complaintAfter([&](Simulation& s) { s.restriction.seconds = nan; }) == steps);
    CHECK(complaintAfter([](Simulation& s) { s.automatic.controls[1].step = 1e-300; }) == steps);
    CHECK(complaintAfter([&](Simulation& s) { s.automatic.controls[1].ratioBefore = nan; }) == steps);
    CHECK(complaintAfter([&](Simulation& s) { s.automatic.controls[1].calibration = nan; }) == steps);
    CHECK(complaintAfter([&](Simulation& s) { s.cache->lastStep = nan; }) == steps);
    CHECK(complaintAfter([&](Simulation& s) { s.cache->meanAccelerations = {Vec3(0, nan, 0)}; }) == steps);
    CHECK(complaintAfter([](Simulation& s) { s.automatic.twin.id.push_back(0); }) == steps);
    TwinRun twin;
    twin.exists = true;
    twin.end = 1.0;
    twin.step = 0.01;
    twin.cost = 100.0;
    CHECK(complaintAfter([&](Simulation& s) { s.automatic.twin = twin; }) != steps);
    const auto complaintOfTwin = [&](auto&& damage) {
        return complaintAfter([&](Simulation& s) {
            s.automatic.twin = twin;
            damage(s.automatic.twin);
        });
    };
    CHECK(complaintOfTwin([](TwinRun& t) { t.stepper = StepperKind::symplecticEuler; }) == steps);
    CHECK(complaintOfTwin([&](TwinRun& t) { t.step = nan; }) == steps);
    CHECK(complaintOfTwin([](TwinRun& t) { t.step = 0.0; }) == steps);
    CHECK(complaintOfTwin([](TwinRun& t) { t.cost = 0.0; }) == steps);
    CHECK(complaintOfTwin([](TwinRun& t) { t.end = t.start; }) == steps);

    CHECK(complaintAfter([&](Simulation& s) { s.particles.velocity[0].y() = nan; }) == "a velocity is not finite");
}

TEST_CASE("A checkpoint of other emitters or materials is refused", "[checkpoint]") {
    const Setup setup = busySetup(StepperKind::velocityVerlet);
    const auto bytes = checkpointOf(setup, 3);
    Setup other = setup;
    other.emitters.front().sites.pop_back();
    CHECK(complaint(other, bytes).find("another scene") != std::string::npos);
    other = setup;
    other.materials.push_back(other.materials.front());
    CHECK(complaint(other, bytes).find("another scene") != std::string::npos);
}
