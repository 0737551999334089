// Runs a copy of the simulation ahead, and finds the same particles in both.
#include "engine/error_control/twin.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "engine/error_control/checked_steps.h"
#include "engine/error_control/step_control.h"
#include "engine/error_control/step_cost.h"
#include "engine/ranks/exact_sums.h"
#include "engine/ranks/exchange.h"
#include "engine/stepping/population.h"
#include "engine/stepping/step_cache.h"
#include "engine/stepping/take_step.h"

namespace engine {
namespace {

/// Number of parts of a twin, at the end of each of which it is given up if it has cost too much. Chosen.
constexpr double kPartsOfTwin = 2.0;

/// A candidate may have spent this many intervals' cost more than the run would have, because its first steps do not
/// have the right length yet. Chosen.
constexpr double kCandidateCredit = 1.0;

/// Advances the copy by equal parts, and gives up, with false, as soon as it has cost more than allowed until then.
/// @param mostPerSecond  force evaluations per second of motion
/// @param credit         force evaluations that it may have spent beyond that before the last part
bool advanceWithin(Simulation& ahead, ErrorControl& errors, double seconds, double parts, double longest,
                   double mostPerSecond, double credit) {
    const double start = ahead.time;
    for (double k = 1.0; k <= parts; ++k) {
        const double most = mostPerSecond * seconds;
        const double allowed = std::min(most, most * k / parts + credit) - forceEvaluationsOf(ahead);
        if (!advanceChecked(ahead, start + seconds * k / parts, longest, StepLimit::error, allowed, &errors))
            return false;
    }
    return true;
}

/// Where a particle is in the run or in a twin.
struct Place {
    Vec3 position;        ///< m
    double radius = 0.0;  ///< m; 0 in the twin
    std::uint32_t id = 0;
};

/// Keeps the end of a copy of the simulation that has run ahead of it.
void keep(Simulation& simulation, const Simulation& ahead, const ErrorControl& errors) {
    TwinRun& twin = simulation.automatic.twin;
    const double seconds = ahead.time - simulation.time;
    twin.exists = true;
    twin.stepper = ahead.stepper;
    twin.start = simulation.time;
    twin.end = ahead.time;
    twin.step = seconds / static_cast<double>(ahead.steps.count);
    twin.estimate = errors.estimate / seconds;
    twin.cost = forceEvaluationsOf(ahead) / seconds;
    // Particles that are emitted on the way are not compared: one that finds no room in the twin gives its id to the
    // next.
    const auto firstNew = std::ranges::lower_bound(ahead.particles.id, simulation.particles.nextId);
    const auto known = firstNew - ahead.particles.id.begin();
    twin.position.assign(ahead.particles.position.begin(), ahead.particles.position.begin() + known);
    twin.id.assign(ahead.particles.id.begin(), firstNew);
    twin.runCost = forceEvaluationsOf(simulation);
}

/// Copies the simulation, lets `run` advance the copy, and keeps its end if `run` returns true.
void send(Simulation& simulation, ErrorControl errors,
          const std::function<bool(Simulation& ahead, ErrorControl& errors)>& run) {
    Simulation ahead = simulation;
    ahead.setup.world.reset();  // the run removes particles, too, and those left are compared
    ahead.steps = {};
    errors.steps.stepBefore = 0.0;
    simulation.automatic.twin = {};
    try {
        if (run(ahead, errors)) keep(simulation, ahead, errors);
    } catch (const InstabilityError&) {
        // The run, with its shorter steps, may not become unstable.
    }
    simulation.automatic.estimateCost += forceEvaluationsOf(ahead);
    ++simulation.automatic.twinCount;
}

}  // namespace

std::uint64_t twinIntervals(double interval) {
    constexpr double kMost = 12.0;  // chosen
    return static_cast<std::uint64_t>(std::min(kMost, stepCount(kTwinSeconds, interval)));
}

bool isEmitting(const Simulation& simulation, double interval) {
    return nextEmission(simulation) < simulation.time + interval * static_cast<double>(twinIntervals(interval));
}

void sendTwin(Simulation& simulation, double interval, double mostPerSecond) {
    const StepperKind stepper = simulation.stepper;
    const double seconds = interval * static_cast<double>(twinIntervals(interval));
    ErrorControl errors{controlOf(simulation, stepper),
                        simulation.setup.error / errorRatio(stepper, 1.0 / kTwinFactor)};
    errors.steps.step *= kTwinFactor;
    // The twin's steps do not end with the intervals, or they might be as long as those of the run.
    send(simulation, errors, [&](Simulation& ahead, ErrorControl& control) {
        return advanceWithin(ahead, control, seconds, kPartsOfTwin, kTwinFactor * interval, mostPerSecond, 0.0);
    });
}

void sendCandidate(Simulation& simulation, StepperKind stepper, double interval, double mostPerSecond) {
    const ErrorControl errors{controlOf(simulation, stepper), simulation.setup.error};
    const double count = std::ceil(0.5 * static_cast<double>(twinIntervals(interval)));
    const double credit = kCandidateCredit * mostPerSecond * interval;
    send(simulation, errors, [&](Simulation& ahead, ErrorControl& control) {
        ahead.stepper = stepper;
        ahead.restriction = {};
        ahead.cache->energy.reset();  // steppers know the energy at different moments of a step
        return advanceWithin(ahead, control, count * interval, count, interval, mostPerSecond, credit);
    });
}

Comparison compareWithTwin(const Simulation& simulation) {
    const TwinRun& twin = simulation.automatic.twin;
    const Particles& particles = simulation.particles;
    const Ranks& ranks = *simulation.ranks;
    // A particle may be on another rank than the twin's, so both are sent to a rank that the id names.
    std::vector<std::vector<Place>> toRanks(static_cast<std::size_t>(ranks.count()));
    const auto send = [&](const Place& place) { toRanks[place.id % toRanks.size()].push_back(place); };
    for (std::size_t p = 0; p < particles.count(); ++p)
        send({particles.position[p], particles.radius[p], particles.id[p]});
    for (std::size_t t = 0; t < twin.id.size(); ++t) send({twin.position[t], 0.0, twin.id[t]});
    std::vector<Place> places = exchangeItems(ranks, toRanks);
    std::ranges::sort(places, [](const Place& one, const Place& other) {
        return one.id != other.id ? one.id < other.id : one.radius > other.radius;
    });
    std::array<ExactSum, 1> sumSq;
    std::uint64_t both = 0;
    for (std::size_t k = 0; k + 1 < places.size(); ++k) {
        const Place& place = places[k];
        if (place.id != places[k + 1].id) continue;
        sumSq[0].add(squaredLength(place.position - places[k + 1].position) / (place.radius * place.radius));
        ++both;
    }
    both = sumOfAll(ranks, both);
    const double rms = both == 0 ? 0.0 : std::sqrt(roundedOverRanks(ranks, sumSq)[0] / static_cast<double>(both));
    const double seconds = twin.end - twin.start;
    return {rms / seconds, twin.runEstimate / seconds, (forceEvaluationsOf(simulation) - twin.runCost) / seconds};
}

}  // namespace engine
