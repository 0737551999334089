// Jets: staggered and grouped emissions, spread velocities, drops, and how much fits.
#include "engine/state/emission.h"

#include <algorithm>
#include <cmath>
#include <set>
#include "tests/catch.h"

#include "engine/run/advance.h"
#include "engine/run/diagnostics.h"
#include "engine/run/fitting_rate.h"
#include "engine/state/emitter_sites.h"
#include "engine/stepping/population.h"

using namespace engine;

namespace {

constexpr double kRadius = 0.15;  // of the default material, m

/// A disc of 19 sites that emits upward, one site after another.
Emitter jet(double interval, double speed) {
    Emitter emitter;
    emitter.velocity = Vec3(0, speed, 0);
    emitter.sites = takingTurns(discSites(Vec3::Zero(), emitter.velocity, 4.0 * kRadius, 2.0 * kRadius));
    emitter.interval = interval;
    emitter.pick = Pick::staggered;
    completeTimes(emitter, Vec3::Zero(), kRadius);
    return emitter;
}

Setup setupOf(const Emitter& emitter) {
    Setup setup;
    setup.gravity = Vec3::Zero();
    setup.emitters = {emitter};
    return setup;
}

/// What an emitter has emitted by a time (s) if its particles fly freely, and at how many moments.
struct Flight {
    Simulation simulation;
    int moments = 0;

    Flight(const Setup& setup, double end) {
        simulation.setup = setup;
        simulation.emitters = {initialState(setup.emitters[0])};
        for (double next = 0.0; next <= end; next = nextEmission(simulation)) {
            moveTo(next);
            emitDue(simulation);
            ++moments;
        }
        moveTo(end);
    }

    void moveTo(double time) {
        Particles& particles = simulation.particles;
        const double h = time - simulation.time;
        for (std::size_t p = 0; p < particles.count(); ++p)
            particles.position[p] += h * particles.velocity[p] + 0.5 * h * h * simulation.setup.gravity;
        simulation.time = time;
    }
};

std::vector<double> sorted(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values;
}

}  // namespace

TEST_CASE("A staggered jet has no layers: its particles are evenly spaced along it", "[emitters]") {
    const double interval = 0.1;
    const double speed = 4.0;
    const Flight flight(setupOf(jet(interval, speed)), 2.0);
    const Particles& particles = flight.simulation.particles;
    std::vector<double> heights;
    for (const Vec3& position : particles.position) heights.push_back(position.y());
    heights = sorted(heights);
    REQUIRE(heights.size() > 300);
    const double gap = speed * interval / 19.0;
    for (std::size_t k = 1; k < heights.size(); ++k)
        CHECK(heights[k] - heights[k - 1] == Approx(gap).epsilon(1e-9));  // sums of a few hundred numbers below 10
    Emitter all = jet(interval, speed);
    all.pick = Pick::all;
    all.clearance = 0.99;  // neighbors are as far apart as a clearance of 1, but for rounding
    all.grouping = 0.0;
    const Flight layers(setupOf(all), 2.0);
    std::set<double> levels;
    for (const Vec3& position : layers.simulation.particles.position) levels.insert(std::round(1e6 * position.y()));
    CAPTURE(levels);
    CHECK(levels.size() == 21);
}

TEST_CASE("A staggered jet ends as few steps as one of layers", "[emitters]") {
    // Layers of a dense jet are 0.3 m apart: one moment an interval.
    CHECK(Flight(setupOf(jet(0.075, 4.0)), 1.5).moments == 21);
    // 0.8 m an interval, which is further than a particle may fly freely: three moments.
    CHECK(Flight(setupOf(jet(0.2, 4.0)), 2.0).moments == 31);
    // Births that are further apart than that have a moment each.
    CHECK(jet(19.0, 4.0).grouping == 0.0);
}

TEST_CASE("Grouping changes when particles are added, but not where they are", "[emitters]") {
    Emitter grouped = jet(0.075, 4.0);
    grouped.jitter = 0.2;
    grouped.spread = 0.1;
    grouped.speedSpread = 0.1;
    grouped.clearance = 0.0;
    REQUIRE(grouped.grouping > 0.0);
    Emitter single = grouped;
    single.grouping = 0.0;
    const auto positionsOf = [](const Emitter& emitter) {
        const Flight flight(setupOf(emitter), 0.75);
        std::vector<Vec3> positions = flight.simulation.particles.position;
        std::sort(positions.begin(), positions.end(), [](const Vec3& a, const Vec3& b) { return a.y() < b.y(); });
        return positions;
    };
    const std::vector<Vec3> some = positionsOf(grouped);
    const std::vector<Vec3> each = positionsOf(single);
    REQUIRE(some.size() == each.size());
    for (std::size_t k = 0; k < some.size(); ++k) CHECK((some[k] - each[k]).norm() < 1e-12);  // sums below 4 m
}

TEST_CASE("The times of a staggered emitter do not depend on the time steps", "[emitters]") {
    Emitter emitter = jet(0.075, 4.0);
    emitter.jitter = 0.1;
    emitter.clearance = 0.8;
    emitter.until = 0.5;
    const auto birthTimes = [&](StepperKind stepper, double step) {
        Setup setup = setupOf(emitter);
        setup.stepper = stepper;
        setup.step = step;
        setup.materials[0].repulsion = 0.0;
        setup.materials[0].damping = 0.0;
        Simulation simulation = start(setup);
        for (int frame = 1; frame <= 20; ++frame) advance(simulation, frame / 30.0);
        CHECK(refusalCount(simulation) == 0);
        return sorted(simulation.particles.birthTime);
    };
    const std::vector<double> expected = birthTimes(StepperKind::velocityVerlet, 0.01);
    CHECK(expected.size() == 19 * 6 + 13);  // six intervals, and two thirds of one
    for (const auto& [stepper, step] : {std::pair{StepperKind::velocityVerlet, 0.003},
                                        {StepperKind::symplecticEuler, 0.007},
                                        {StepperKind::automatic, 0.0}}) {
        const std::vector<double> times = birthTimes(stepper, step);
        REQUIRE(times.size() == expected.size());
        for (std::size_t k = 0; k < times.size(); ++k) CHECK(times[k] == Approx(expected[k]).margin(1e-12));
    }
}

TEST_CASE("Directions are spread evenly over a cone, and speeds over a range", "[emitters]") {
    Emitter emitter;
    emitter.sites = {Vec3::Zero()};
    emitter.velocity = Vec3(3, -4, 0);
    emitter.spread = oneMinusCosine(25.0);
    emitter.speedSpread = 0.2;
    const Setup setup = setupOf(emitter);
    constexpr int kCount = 4000;
    std::vector<NewParticle> particles;
    double cosines = 0.0;
    double speeds = 0.0;
    double narrowest = 1.0;
    Vec3 mean = Vec3::Zero();
    for (std::uint64_t k = 0; k < kCount; ++k) {
        drawEmission(setup, {0, 0, k}, 0.0, 0.0, particles);
        REQUIRE(particles.size() == 1);
        const double speed = particles[0].velocity.norm();
        const double cosine = particles[0].velocity.dot(emitter.velocity) / (5.0 * speed);
        CHECK(speed >= 4.0 - 1e-12);
        CHECK(speed <= 6.0 + 1e-12);
        CHECK(cosine >= std::cos(25.0 * std::acos(-1.0) / 180.0) - 1e-12);
        cosines += cosine / kCount;
        speeds += speed / kCount;
        narrowest = std::min(narrowest, cosine);
        mean += particles[0].velocity / kCount;
    }
    // Evenly over the cap: the mean cosine is halfway. Both tolerances are four standard errors of 4000 draws.
    CHECK(cosines == Approx(1.0 - 0.5 * emitter.spread).margin(4.0 * emitter.spread / std::sqrt(12.0 * kCount)));
    CHECK(speeds == Approx(5.0).margin(4.0 * 2.0 / std::sqrt(12.0 * kCount)));
    CHECK(narrowest < 1.0 - 0.99 * emitter.spread);
    CHECK(mean.cross(emitter.velocity / 5.0).norm() < 4.0 * 5.0 * std::sin(25.0 / 57.3) / std::sqrt(2.0 * kCount));
}

TEST_CASE("A cluster is emitted whole or not at all, and turned at random", "[emitters]") {
    Emitter emitter;
    emitter.sites = {Vec3::Zero()};
    emitter.velocity = Vec3(0, -3, 0);
    emitter.cluster = clusterPositions(13, 2.0 * kRadius);
    emitter.interval = 0.1;  // a third of the drop's own height
    emitter.limit = 70;      // five drops and a rest that is none
    const Flight flight(setupOf(emitter), 4.0);
    const Particles& particles = flight.simulation.particles;
    REQUIRE(particles.count() == 65);
    CHECK(askedCount(emitter, 4.0) == 65);
    CHECK(refusalCount(flight.simulation) == 0);
    for (std::size_t p = 0; p < 65; ++p)
        for (std::size_t q = 0; q < p; ++q)
            CHECK((particles.position[p] - particles.position[q]).norm() >= 2.0 * kRadius - 1e-9);
    for (std::size_t drop = 0; drop < 5; ++drop) {
        Vec3 mean = Vec3::Zero();
        for (std::size_t k = 0; k < 13; ++k) mean += particles.position[13 * drop + k] / 13.0;
        CHECK(std::abs(mean.x()) < 1e-12);
        CHECK(particles.birthTime[13 * drop] == particles.birthTime[13 * drop + 12]);
    }
    const Vec3 first = particles.position[0] - particles.position[1];
    const Vec3 second = particles.position[13] - particles.position[14];
    CHECK((first - second).norm() > 1e-3);
    CHECK(askedCount(emitter, 0.25) == 39);
    CHECK(Flight(setupOf(emitter), 0.25).simulation.emitters[0].births < 39);
}

TEST_CASE("A particle has left its site after the time that free flight takes", "[emitters]") {
    const double infinite = std::numeric_limits<double>::infinity();
    CHECK(timeToMove(Vec3(0, 2, 0), Vec3::Zero(), 0.5) == 0.25);
    CHECK(timeToMove(Vec3::Zero(), Vec3::Zero(), 0.5) == infinite);
    CHECK(timeToMove(Vec3::Zero(), Vec3(0, -10, 0), 0.2) == Approx(0.2));
    CHECK(timeToMove(Vec3(0, -1, 0), Vec3(0, -10, 0), 0.6) == Approx(0.26055512754));  // t + 5 t^2 = 0.6
    CHECK(timeToMove(Vec3(0, 4, 0), Vec3(0, -10, 0), 0.6) == Approx(0.2));             // 4 t - 5 t^2 = 0.6
    // A throw that turns 0.2 m above the site is 0.6 m below it later: 2 t - 5 t^2 = -0.6.
    CHECK(timeToMove(Vec3(0, 2, 0), Vec3(0, -10, 0), 0.6) == Approx(0.6));
    CHECK(timeToMove(Vec3(3, 0, 0), Vec3(0, -10, 0), 0.7) == Approx(0.21917).epsilon(1e-4));  // 9 t^2 + 25 t^4 = 0.49
}

TEST_CASE("The share that fits follows from speed, clearance and sites", "[emitters]") {
    const auto shareOf = [](const Emitter& emitter) { return fittingShare(setupOf(emitter), 0); };
    // 0.3 m at 4 m/s take 0.075 s.
    CHECK(shareOf(jet(0.0751, 4.0)) == 1.0);
    CHECK(shareOf(jet(0.0375, 4.0)) == Approx(0.5).epsilon(0.07));  // a sixteenth for the delays
    CHECK(shareOf(jet(0.0075, 4.0)) == Approx(0.1).epsilon(0.07));
    Emitter overlapping = jet(0.0075, 4.0);
    overlapping.clearance = 0.0;
    CHECK(shareOf(overlapping) == 1.0);
    Emitter closer = jet(0.0376, 4.0);
    closer.clearance = 0.5;
    CHECK(shareOf(closer) == Approx(1.0).epsilon(0.07));
    Emitter still = jet(0.1, 0.0);
    CHECK(shareOf(still) < 0.05);
    Emitter random = jet(0.01, 4.0);  // 100/s of 19 sites that could give 253/s
    random.pick = Pick::random;
    completeTimes(random, Vec3::Zero(), kRadius);
    CHECK(shareOf(random) > 0.95);
    random.interval = 0.001;  // four times what they could give
    completeTimes(random, Vec3::Zero(), kRadius);
    CHECK(shareOf(random) < 0.26);
    CHECK(shareOf(random) > 0.15);
}

TEST_CASE("A jet as dense as fits gives what it was asked for", "[emitters]") {
    Emitter emitter = jet(1.0, 4.0);
    emitter.clearance = 0.86;
    emitter.jitter = 0.1;
    emitter.interval = 1.001 * clearingTime(emitter, Vec3::Zero(), kRadius);
    completeTimes(emitter, Vec3::Zero(), kRadius);
    const Flight flight(setupOf(emitter), 3.0);
    const auto asked = static_cast<double>(askedCount(emitter, 3.0));
    CHECK(asked == Approx(19.0 * 3.0 * 4.0 / (0.3 * 0.86)).epsilon(0.02));
    CHECK(static_cast<double>(flight.simulation.emitters[0].births) > 0.99 * asked);
}
