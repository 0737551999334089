// Runs a copy of the simulation ahead, and finds the same particles in both.
#include "engine/error_control/twin.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "engine/error_control/checked_steps.h"
#include "engine/error_control/step_control.h"
#include "engine/error_control/step_cost.h"
#include "engine/stepping/step_cache.h"
#include "engine/stepping/take_step.h"

namespace engine {
namespace {

/// A candidate may have spent this many intervals' cost more than the run would have, because its first steps do not
/// have the right length yet. Chosen.
constexpr double kCandidateCredit = 1.0;

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

void sendTwin(Simulation& simulation, double interval, double mostPerSecond) {
    const StepperKind stepper = simulation.stepper;
    const double seconds = interval * static_cast<double>(twinIntervals(interval));
    ErrorControl errors{controlOf(simulation, stepper),
                        simulation.setup.error / errorRatio(stepper, 1.0 / kTwinFactor)};
    errors.steps.step *= kTwinFactor;
    // The twin's steps do not end with the intervals, or they might be as long as those of the run.
    send(simulation, errors, [&](Simulation& ahead, ErrorControl& control) {
        return advanceChecked(ahead, simulation.time + seconds, kTwinFactor * interval, StepLimit::error,
                              mostPerSecond * seconds, &control);
    });
}

void sendCandidate(Simulation& simulation, StepperKind stepper, double interval, double mostPerSecond) {
    const ErrorControl errors{controlOf(simulation, stepper), simulation.setup.error};
    const double count = std::ceil(0.5 * static_cast<double>(twinIntervals(interval)));
    send(simulation, errors, [&](Simulation& ahead, ErrorControl& control) {
        ahead.stepper = stepper;
        ahead.restriction = {};
        ahead.cache->energy.reset();  // steppers know the energy at different moments of a step
        for (double k = 1.0; k <= count; ++k) {
            const double allowed = mostPerSecond * interval * std::min(count, k + kCandidateCredit);
            const double end = simulation.time + k * interval;
            if (!advanceChecked(ahead, end, interval, StepLimit::error, allowed - forceEvaluationsOf(ahead), &control))
                return false;
        }
        return true;
    });
}

Comparison compareWithTwin(const Simulation& simulation) {
    const TwinRun& twin = simulation.automatic.twin;
    const Particles& particles = simulation.particles;
    double sumSq = 0.0;
    std::size_t both = 0;
    for (std::size_t p = 0, t = 0; p < particles.count() && t < twin.id.size();) {
        if (particles.id[p] == twin.id[t]) {
            const double radius = particles.radius[p];
            sumSq += squaredLength(particles.position[p] - twin.position[t]) / (radius * radius);
            ++both;
        }
        const bool isBehind = particles.id[p] < twin.id[t];
        if (particles.id[p] <= twin.id[t]) ++p;
        if (!isBehind) ++t;
    }
    const double seconds = twin.end - twin.start;
    const double rms = both == 0 ? 0.0 : std::sqrt(sumSq / static_cast<double>(both));
    return {rms / seconds, twin.runEstimate / seconds, (forceEvaluationsOf(simulation) - twin.runCost) / seconds};
}

}  // namespace engine
