// Estimates errors and costs, chooses, and goes on. Costs are counted in force evaluations, never timed, so that a
// choice depends on the states alone.
#include "engine/error_control/auto_stepper.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "engine/core/parallel.h"
#include "engine/error_control/checked_steps.h"
#include "engine/error_control/error_estimate.h"
#include "engine/error_control/long_error_estimate.h"
#include "engine/error_control/step_cost.h"
#include "engine/stepping/population.h"
#include "engine/stepping/step_audit.h"
#include "engine/stepping/step_cache.h"
#include "engine/stepping/steppers.h"

namespace engine {
namespace {

constexpr std::array kCandidates = {StepperKind::velocityVerlet, StepperKind::leapfrog, StepperKind::implicitDamping,
                                    StepperKind::linearlyImplicit};
static_assert(kRunsOfEstimate == kCandidates.size() + 1);

/// Chosen: every so many error estimates all candidates are compared.
constexpr std::uint64_t kEstimatesPerComparison = 5;

/// Chosen: an interval in which the acceleration has grown by this factor since the last estimate is run again, with an
/// estimate.
constexpr double kSurprisingGrowth = 2.0;

/// Chosen: a step is settled when it would change by less than this factor.
constexpr double kSettledRatio = 1.5;

/// Measured on the scenes of `globular study accuracy`: beyond these limits a growth of errors reflects one event, not
/// the motion as a whole.
constexpr double kLeastGrowth = 0.5;
constexpr double kMostGrowth = 16.0;

/// Chosen: trials in a row of a candidate until its step has settled, the first time and later.
constexpr int kMostFirstTrials = 6;
constexpr int kMostTrials = 2;

/// Chosen: a candidate that costs this many times as much as another is not measured any further.
constexpr double kHopelessCostRatio = 3.0;

/// Chosen: force evaluations that a candidate may take over the interval, at first. The limit is doubled while no
/// candidate gets through with it.
constexpr double kFirstEvaluations = 16.0;

/// Chosen: the longest pause that a costly estimate causes, in intervals.
constexpr double kLongestCostPause = 64.0;

/// Chosen: the velocity that the implicit steppers' solver may leave out, as a share of the wanted error over the time
/// for which a wrong velocity counts; small beside the error of the step itself.
constexpr double kSolverShare = 0.2;

/// Chosen: intervals until the next estimate where a step has not settled, or has only just changed.
constexpr std::uint64_t kShortPause = 2;

AutoChoice& choiceOf(Simulation& simulation, StepperKind stepper) {
    return simulation.automatic.choices[static_cast<std::size_t>(stepper)];
}

bool isSettled(double ratio) {
    return std::max(ratio, 1.0 / ratio) < kSettledRatio;
}

/// Changes the step (s) of a choice, and the cost with it.
void fit(AutoChoice& choice, const Trial& trial, double step, double interval) {
    choice.step = std::clamp(step, kShortestStep, interval);
    choice.cost = costAt(trial, choice.step);
}

/// Updates a choice by a trial of it.
void choose(AutoChoice& choice, const Trial& trial, double wantedError, double interval) {
    const double wanted = wantedStep(trial, wantedError);
    fit(choice, trial, wanted, interval);
    choice.reason = trial.restricted && wanted >= trial.step ? *trial.reason
                    : wanted >= interval                     ? StepLimit::frame
                                                             : StepLimit::error;
}

/// Cost of the cheapest candidate that has been measured, force evaluations per second of motion.
double cheapestCost(const Simulation& simulation) {
    double least = std::numeric_limits<double>::infinity();
    for (const AutoChoice& choice : simulation.automatic.choices) least = std::min(least, choice.cost);
    return least;
}

/// Marks a choice as unknown.
void forget(AutoChoice& choice) {
    choice.step = 0.0;
    choice.cost = std::numeric_limits<double>::infinity();
}

/// Sets how exactly the implicit steppers' solver works. To be called before a candidate runs.
void setSolverTolerance(Simulation& simulation, const AutoChoice& choice) {
    simulation.cache->toleratedAcceleration = acceptableResidual(simulation) / std::max(1.0, choice.growth);
}

/// Measures a candidate and updates its choice. Repeats that while the step has to become much shorter, and the first
/// time until the step has settled; ends early where the candidate costs far more than another one or than it may.
Trial measureCandidate(Simulation& simulation, double time, StepperKind stepper, double mostEvaluations,
                       Simulation* finer) {
    AutoChoice& choice = choiceOf(simulation, stepper);
    const double interval = time - simulation.time;
    const double wantedError = simulation.setup.error / choice.growth;
    const auto runTrial = [&] {
        const Trial trial = measure(simulation, {time, stepper, choice.step, kErrorHorizon, mostEvaluations}, finer);
        simulation.automatic.estimateCost += trial.spent;
        if (!trial.finished) forget(choice);
        return trial;
    };
    setSolverTolerance(simulation, choice);
    const bool first = choice.step == 0.0;
    if (first) choice.step = 0.25 * interval;
    Trial trial = runTrial();
    if (!trial.finished) return trial;
    choose(choice, trial, wantedError, interval);
    for (int round = 1; round < (first ? kMostFirstTrials : kMostTrials); ++round) {
        const double ratio = stepRatioTo(trial, choice.step);
        if (isSettled(ratio) || choice.step == interval || (ratio > 1.0 && !first)) break;
        if (choice.cost > kHopelessCostRatio * cheapestCost(simulation)) break;
        const Trial before = trial;
        trial = runTrial();
        if (!trial.finished) break;
        if (ratio < 1.0 && trial.error > kWasted * before.error) {
            trial = before;
            choice.step = before.asked;
            choice.cost = before.cost;
            choice.reason = StepLimit::error;
            break;
        }
        choose(choice, trial, wantedError, interval);
    }
    return trial;
}

/// Index of the cheapest candidate.
std::size_t cheapest(Simulation& simulation) {
    const auto best = std::min_element(kCandidates.begin(), kCandidates.end(), [&](StepperKind a, StepperKind b) {
        return choiceOf(simulation, a).cost < choiceOf(simulation, b).cost;
    });
    return static_cast<std::size_t>(best - kCandidates.begin());
}

/// Records the error that a trial estimates for the step in use.
void recordEstimate(AutoState& state, const Trial& trial) {
    const AutoChoice& choice = state.choices[static_cast<std::size_t>(trial.stepper)];
    const double ratio = stepRatioTo(trial, choice.step);
    const double error = trial.error * errorRatio(trial.stepper, ratio) * choice.growth;
    ++state.estimateCount;
    state.errorSum += error;
    state.largestError = std::max(state.largestError, error);
}

/// Replaces the simulation by the finer run of a trial; what was learned of the candidates stays.
void continueFrom(Simulation& simulation, Simulation&& finer) {
    StepStatistics steps = simulation.steps;
    steps += finer.steps;
    const AutoState automatic = simulation.automatic;
    simulation = std::move(finer);
    simulation.automatic = automatic;
    simulation.steps = steps;
}

/// A trial of a candidate, and its finer run, from which the simulation may go on.
struct MeasuredCandidate {
    Trial trial;
    Simulation finer;
};

/// Adapts a candidate's step to how its errors grow beyond one interval.
void applyLongEstimate(Simulation& simulation, double time, const Trial& near) {
    AutoState& state = simulation.automatic;
    const double interval = time - simulation.time;
    AutoChoice& choice = choiceOf(simulation, near.stepper);
    setSolverTolerance(simulation, choice);
    const LongEstimate far = estimateLongError(simulation, near.stepper, choice.step, interval);
    state.estimateCost += far.spent;
    const double ratio = stepRatioTo(near, far.step);
    const double nearError = near.error * errorRatio(near.stepper, ratio);
    if (!(nearError > 0.0)) return;
    const double seen = simulation.setup.error / nearError;
    // The growth known so far counts as much as the new one: a single collision may happen to fall into this estimate.
    const double likely = std::clamp(seen, kLeastGrowth, kMostGrowth);
    const double growth = choice.followed ? std::sqrt(choice.growth * likely) : likely;
    fit(choice, far.trial, far.step * stepRatio(near.stepper, seen / growth), interval);
    choice.growth = growth;
    choice.followed = true;
}

/// Estimates how the errors of the cheapest candidate grow beyond one interval, and then of the one that is the
/// cheapest after that, until the cheapest has been followed in this way: near its limit of stability a stepper may
/// seem cheap over one interval. Damping of one candidate's errors is taken to damp those of another that has never
/// been followed, too.
void followCheapest(Simulation& simulation, double time,
                    const std::array<MeasuredCandidate, kCandidates.size()>& measured) {
    std::array<bool, kCandidates.size()> followed{};
    for (std::size_t best = cheapest(simulation); !followed[best]; best = cheapest(simulation)) {
        followed[best] = true;
        applyLongEstimate(simulation, time, measured[best].trial);
        const double growth = choiceOf(simulation, kCandidates[best]).growth;
        for (std::size_t c = 0; c < kCandidates.size(); ++c) {
            AutoChoice& other = choiceOf(simulation, kCandidates[c]);
            if (other.followed || other.step == 0.0 || other.growth <= growth) continue;
            fit(other, measured[c].trial, other.step * stepRatio(kCandidates[c], other.growth / growth),
                time - simulation.time);
            other.growth = growth;
        }
    }
}

/// Intervals to run before the next estimate: they must cost at least what the estimate did, except after the first.
std::uint64_t pauseAfter(std::uint64_t estimateCount, bool isSteady, double estimateIntervals) {
    const std::uint64_t pause = isSteady ? std::min(kLongestPause, 2 * estimateCount) : kShortPause;
    if (estimateCount == 1) return pause;
    return std::max(pause, static_cast<std::uint64_t>(std::min(kLongestCostPause, estimateIntervals)));
}

/// Measures all candidates, the one in use first, and how the errors of the cheapest grow; returns the cheapest one
/// after that.
MeasuredCandidate compare(Simulation& simulation, double time) {
    AutoState& state = simulation.automatic;
    const double interval = time - simulation.time;
    const AutoChoice& inUse = choiceOf(simulation, simulation.stepper);
    double most = std::max(kFirstEvaluations, inUse.step > 0.0 ? kHopelessCostRatio * inUse.cost * interval : 0.0);
    for (AutoChoice& choice : state.choices) choice.cost = std::numeric_limits<double>::infinity();
    std::array<MeasuredCandidate, kCandidates.size()> measured;
    std::array<std::size_t, kCandidates.size()> order{};
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_partition(order.begin(), order.end(),
                          [&](std::size_t c) { return kCandidates[c] == simulation.stepper; });
    for (; std::isinf(cheapestCost(simulation)); most *= 2.0)
        for (const std::size_t c : order) {
            const double mostNow = std::min(most, kHopelessCostRatio * cheapestCost(simulation) * interval);
            measured[c].trial = measureCandidate(simulation, time, kCandidates[c], mostNow, &measured[c].finer);
        }
    followCheapest(simulation, time, measured);
    return std::move(measured[cheapest(simulation)]);
}

/// Runs the interval up to the given time with an error estimate, chooses the step and, now and then, the stepper, and
/// goes on from the finer run.
void estimateAndChoose(Simulation& simulation, double time) {
    AutoState& state = simulation.automatic;
    const double interval = time - simulation.time;
    const double spentBefore = state.estimateCost;
    const auto known = state.choices;
    MeasuredCandidate measured;
    if (state.estimateCount % kEstimatesPerComparison == 0) {
        measured = compare(simulation, time);
    } else {
        constexpr double kAny = std::numeric_limits<double>::infinity();
        measured.trial = measureCandidate(simulation, time, simulation.stepper, kAny, &measured.finer);
    }
    const Trial& trial = measured.trial;
    state.estimateCost -= forceEvaluationsOf(measured.finer);  // the run goes on from these, so they are no extra cost
    const AutoChoice& choice = choiceOf(simulation, trial.stepper);
    recordEstimate(state, trial);
    // One collision that needs a much shorter step must not set the step of many frames.
    const double knownStep = known[static_cast<std::size_t>(trial.stepper)].step;
    const bool isSteady =
        isSettled(stepRatioTo(trial, choice.step)) && (knownStep == 0.0 || isSettled(choice.step / knownStep));
    state.nextEstimate =
        state.intervalCount +
        pauseAfter(state.estimateCount, isSteady, (state.estimateCost - spentBefore) / (choice.cost * interval));
    continueFrom(simulation, std::move(measured.finer));
}

/// RMS over the particles of the mean acceleration other than gravity since a saved state, m/s^2.
double rmsAccelerationSince(const Simulation& simulation, const SavedState& before) {
    const std::size_t count = before.velocity.size();
    const double duration = simulation.time - before.time;
    const Vec3 fall = duration * simulation.setup.gravity;
    const double sumSq = sumOver(count, [&](std::size_t p) {
        return squaredLength(simulation.particles.velocity[p] - before.velocity[p] - fall);
    });
    return std::sqrt(sumSq / static_cast<double>(count)) / duration;
}

/// Smallest radius of the particles, of which there is at least one, m.
double smallestRadius(const Particles& particles) {
    return *std::min_element(particles.radius.begin(), particles.radius.end());
}

/// Whether the motion has changed since the last estimate, for example by an impact.
bool hasMotionChanged(const Simulation& simulation, const SavedState& before) {
    // Changes of velocity below the wanted error do not matter.
    const double least =
        simulation.setup.error * smallestRadius(simulation.particles) / (simulation.time - before.time);
    return rmsAccelerationSince(simulation, before) >
           kSurprisingGrowth * std::max(simulation.automatic.rmsAcceleration, least);
}

/// Whether the numbers of a choice are possible; NaNs are not.
bool isChoice(const AutoChoice& choice) {
    const bool isUnknown = choice.step == 0.0;
    return (isUnknown || choice.step >= kShortestStep) && std::isfinite(choice.step) && choice.cost >= 0.0 &&
           isLimit(choice.reason) && choice.growth >= kLeastGrowth && choice.growth <= kMostGrowth;
}

}  // namespace

double acceptableResidual(const Simulation& simulation) {
    return kSolverShare * simulation.setup.error * smallestRadius(simulation.particles) / kErrorHorizon;
}

bool isReachable(const AutoState& state, StepperKind inUse) {
    if (std::find(kCandidates.begin(), kCandidates.end(), inUse) == kCandidates.end()) return false;
    const bool isKnown = state.choices[static_cast<std::size_t>(inUse)].step > 0.0;
    return std::all_of(state.choices.begin(), state.choices.end(), isChoice) &&
           (isKnown || state.intervalCount >= state.nextEstimate) && state.rmsAcceleration >= 0.0;
}

void advanceAutomatically(Simulation& simulation, double time) {
    emitDue(simulation);
    const AutoState& state = simulation.automatic;
    if (simulation.particles.count() == 0) {
        simulation.cache->toleratedAcceleration = 0.0;
        advanceChecked(simulation, time, time - simulation.time, StepLimit::frame);
        return;
    }
    SavedState before;
    save(simulation, before);
    bool needsEstimate = state.intervalCount >= state.nextEstimate;
    if (!needsEstimate) {
        const AutoChoice& choice = choiceOf(simulation, simulation.stepper);
        setSolverTolerance(simulation, choice);
        advanceChecked(simulation, time, choice.step, choice.reason);
        needsEstimate = hasMotionChanged(simulation, before);
        if (needsEstimate) restore(simulation, before);
    }
    if (needsEstimate) {
        estimateAndChoose(simulation, time);
        simulation.automatic.rmsAcceleration = rmsAccelerationSince(simulation, before);
    }
    ++simulation.automatic.intervalCount;
}

}  // namespace engine
