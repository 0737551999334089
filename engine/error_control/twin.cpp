// Runs a copy of the simulation ahead, and finds the same particles in both.
#include "engine/error_control/twin.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/error_control/checked_steps.h"
#include "engine/error_control/step_cost.h"
#include "engine/stepping/step_cache.h"
#include "engine/stepping/take_step.h"

namespace engine {
namespace {

/// Runs the copy to the end of the twin and keeps its positions; returns whether it got there.
bool runAhead(Simulation& ahead, ErrorControl& errors, double interval, double mostEvaluations, TwinRun& twin) {
    ahead.setup.world.reset();  // the run removes particles, too, and those left are compared
    ahead.steps = {};
    const std::uint32_t firstNew = ahead.particles.nextId;
    const double count = std::min(kMostTwinIntervals, stepCount(kTwinSeconds, interval));
    twin.start = ahead.time;
    twin.end = ahead.time + count * interval;
    for (double k = 1.0; k <= count; ++k) {
        const double left = mostEvaluations - forceEvaluationsOf(ahead);
        const double end = k == count ? twin.end : twin.start + k * interval;
        if (!advanceChecked(ahead, end, interval, StepLimit::error, left, &errors)) return false;
    }
    const double seconds = twin.end - twin.start;
    twin.stepper = ahead.stepper;
    twin.step = seconds / static_cast<double>(ahead.steps.count);
    twin.nextStep = errors.steps.step;
    twin.estimate = errors.estimate / seconds;
    twin.cost = forceEvaluationsOf(ahead) / seconds;
    // Particles that are emitted on the way are not compared: one that finds no room in the twin gives its id to the
    // next.
    const auto known = std::ranges::lower_bound(ahead.particles.id, firstNew) - ahead.particles.id.begin();
    twin.position.assign(ahead.particles.position.begin(), ahead.particles.position.begin() + known);
    twin.id.assign(ahead.particles.id.begin(), ahead.particles.id.begin() + known);
    return true;
}

/// Sends a twin of the stepper that `ahead`, a copy of the simulation, has in use.
void send(Simulation& simulation, Simulation&& ahead, ErrorControl errors, double interval, double mostEvaluations) {
    AutoState& state = simulation.automatic;
    TwinRun twin;
    try {
        twin.exists = runAhead(ahead, errors, interval, mostEvaluations, twin);
    } catch (const InstabilityError&) {
        // The run, with its shorter steps, may not become unstable.
    }
    state.estimateCost += forceEvaluationsOf(ahead);
    ++state.twinCount;
    twin.runSteps = static_cast<double>(simulation.steps.count);
    twin.runCost = forceEvaluationsOf(simulation);
    state.twin = std::move(twin);
}

}  // namespace

void sendTwin(Simulation& simulation, double interval) {
    Simulation ahead = simulation;
    const StepperKind stepper = simulation.stepper;
    ErrorControl errors{simulation.automatic.controls[static_cast<std::size_t>(stepper)],
                        simulation.setup.error / errorRatio(stepper, 1.0 / kTwinFactor)};
    errors.steps.step *= kTwinFactor;
    errors.steps.stepBefore = 0.0;
    send(simulation, std::move(ahead), errors, interval, std::numeric_limits<double>::infinity());
}

void sendCandidate(Simulation& simulation, StepperKind stepper, double interval, double mostPerSecond) {
    Simulation ahead = simulation;
    ahead.stepper = stepper;
    ahead.restriction = {};
    ahead.cache->energy.reset();  // steppers know the energy at different moments of a step
    ErrorControl errors{simulation.automatic.controls[static_cast<std::size_t>(stepper)], simulation.setup.error};
    errors.steps.stepBefore = 0.0;
    const double seconds = interval * std::min(kMostTwinIntervals, stepCount(kTwinSeconds, interval));
    send(simulation, std::move(ahead), errors, interval, mostPerSecond * seconds);
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
    const double steps = static_cast<double>(simulation.steps.count) - twin.runSteps;
    return {rms / seconds, seconds / std::max(1.0, steps), twin.runEstimate / seconds,
            (forceEvaluationsOf(simulation) - twin.runCost) / seconds};
}

}  // namespace engine
