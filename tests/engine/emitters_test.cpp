// Emission: at the right times and places, and never on top of another particle unless the scene allows it.
#include "engine/stepping/population.h"

#include "engine/state/emitter_sites.h"

#include <cmath>
#include <set>
#include "tests/catch.h"

using namespace engine;

namespace {

Emitter pointEmitter(double interval, const Vec3& velocity) {
    Emitter emitter;
    emitter.sites = {Vec3::Zero()};
    emitter.interval = interval;
    emitter.velocity = velocity;
    return emitter;
}

/// Runs an emitter alone, moving its particles freely without gravity.
struct Run {
    Simulation simulation;

    explicit Run(const Emitter& emitter) {
        simulation.setup.gravity = Vec3::Zero();
        simulation.setup.emitters = {emitter};
        simulation.emitters = {initialState(emitter)};
    }

    void until(double end, double step) {
        Particles& particles = simulation.particles;
        for (int k = 0; k * step < end; ++k) {
            simulation.time = k * step;
            emitDue(simulation);
            for (std::size_t p = 0; p < particles.count(); ++p) particles.position[p] += step * particles.velocity[p];
        }
    }
};

}  // namespace

TEST_CASE("A point nozzle emits at its interval, evenly spaced whatever the step", "[emitters]") {
    for (const double step : {0.01, 0.004, 0.0137}) {
        Run run{pointEmitter(0.1, Vec3(0, 10, 0))};
        run.until(0.95, step);
        REQUIRE(run.simulation.particles.count() == 10);
        for (std::size_t p = 1; p < 10; ++p) {
            const double gap = run.simulation.particles.position[p - 1].y() - run.simulation.particles.position[p].y();
            CHECK(gap == Approx(1.0).epsilon(1e-12));  // sums of a hundred steps
        }
        CHECK(refusalCount(run.simulation) == 0);
    }
}

TEST_CASE("A particle that is emitted late has fallen with gravity", "[emitters]") {
    Run run{pointEmitter(1.0, Vec3(2, 0, 0))};
    run.simulation.setup.gravity = Vec3(0, -8, 0);
    run.simulation.time = 0.5;
    emitDue(run.simulation);
    const Particles& particles = run.simulation.particles;
    REQUIRE(particles.count() == 1);
    CHECK(particles.position[0] == Vec3(1.0, -1.0, 0.0));
    CHECK(particles.velocity[0] == Vec3(2.0, -4.0, 0.0));
    CHECK(particles.birthTime[0] == 0.0);
}

TEST_CASE("An emission without room waits, and what is not emitted for it is counted", "[emitters]") {
    Run run{pointEmitter(0.1, Vec3(0, 1, 0))};  // 0.1 m per interval, 0.3 m needed
    run.until(2.0, 0.01);
    for (std::size_t p = 1; p < run.simulation.particles.count(); ++p)
        CHECK((run.simulation.particles.position[p] - run.simulation.particles.position[p - 1]).norm() >=
              0.3 - 1e-12);                        // rounding of sums
    CHECK(run.simulation.particles.count() == 7);  // every 0.3 s
    CHECK(run.simulation.emitters[0].births == 7);
    CHECK(askedCount(run.simulation.setup.emitters[0], run.simulation.time) == 20);  // 0 0.1 ... 1.9
    CHECK(refusalCount(run.simulation) == 13);
}

TEST_CASE("Clearance zero allows overlaps, as published", "[emitters]") {
    Emitter emitter = pointEmitter(0.1, Vec3::Zero());
    emitter.clearance = 0.0;
    Run run{emitter};
    run.until(0.95, 0.01);
    CHECK(run.simulation.particles.count() == 10);
    CHECK(refusalCount(run.simulation) == 0);
}

TEST_CASE("Start, until and limit bound the emissions", "[emitters]") {
    Emitter emitter = pointEmitter(0.1, Vec3(0, 10, 0));
    emitter.start = 0.25;
    emitter.until = 0.65;
    Run timed{emitter};
    timed.until(2.0, 0.01);
    CHECK(timed.simulation.particles.count() == 4);  // 0.25 0.35 0.45 0.55
    emitter.until = 1e9;
    emitter.limit = 3;
    Run limited{emitter};
    limited.until(2.0, 0.01);
    CHECK(limited.simulation.particles.count() == 3);
}

TEST_CASE("Random choice is seeded and reaches every site", "[emitters]") {
    Emitter emitter = pointEmitter(0.02, Vec3(0, 15, 0));
    emitter.sites = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(2, 0, 0), Vec3(3, 0, 0), Vec3(4, 0, 0)};
    emitter.pick = Pick::random;
    const auto columns = [&](std::uint64_t seed) {
        Run run{emitter};
        run.simulation.setup.seed = seed;
        run.until(2.0, 0.01);
        std::vector<double> x;
        for (const Vec3& position : run.simulation.particles.position) x.push_back(position.x());
        return x;
    };
    const auto first = columns(1);
    CHECK(first.size() == 100);
    CHECK(std::set<double>(first.begin(), first.end()).size() == 5);
    CHECK(columns(1) == first);
    CHECK(columns(2) != first);
}

TEST_CASE("All sites of a disc emit on their own schedules", "[emitters]") {
    Emitter emitter = pointEmitter(0.1, Vec3(0, 10, 0));
    emitter.sites = discSites(Vec3::Zero(), emitter.velocity, 0.3, 0.3);
    Run run{emitter};
    append(run.simulation.particles, {.position = emitter.sites[0]});  // blocks one of the seven for ever
    run.until(0.55, 0.01);
    CHECK(run.simulation.particles.count() == 1 + 6 * 6);
    CHECK(refusalCount(run.simulation) == 6);
}

TEST_CASE("Jitter displaces particles across the velocity only", "[emitters]") {
    Emitter emitter = pointEmitter(0.1, Vec3(0, 10, 0));
    emitter.jitter = 0.2;
    Run run{emitter};
    run.until(0.95, 0.01);
    double largest = 0.0;
    for (std::size_t p = 0; p < run.simulation.particles.count(); ++p) {
        largest = std::max({largest, std::abs(run.simulation.particles.position[p].x()),
                            std::abs(run.simulation.particles.position[p].z())});
    }
    CHECK(largest > 0.005);
    CHECK(largest <= 0.2 * 0.15);
}
