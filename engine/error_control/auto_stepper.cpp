// The automatic stepper: estimates errors and costs of the candidate steppers and chooses one. Costs are counted in
// force evaluations, never timed, so that a choice depends only on the states.
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
#include "engine/stepping/take_step.h"

namespace engine {
namespace {

constexpr std::array kCandidates = {StepperKind::velocityVerlet, StepperKind::leapfrog, StepperKind::implicitDamping,
                                    StepperKind::linearlyImplicit};
static_assert(kRunsOfEstimate == kCandidates.size() + 1);

/// Number of error estimates from one comparison of all candidates to the next. Chosen.
constexpr std::uint64_t kEstimatesPerComparison = 5;

/// If the acceleration in an interval is larger by this factor than at the last error estimate, the interval is run
/// again with an estimate. Chosen.
constexpr double kSurprisingGrowth = 2.0;

/// The step of a candidate counts as settled if a new measurement changes it by less than this factor. Chosen.
constexpr double kSettledRatio = 1.5;

/// Limits on the factor by which errors grow beyond one interval. Measured on the scenes of `globular study accuracy`:
/// outside these limits the growth is due to a single event, not to the motion as a whole.
constexpr double kLeastGrowth = 0.5;
constexpr double kMostGrowth = 16.0;

/// Largest number of trial runs in a row in which the step of a candidate, one of the steppers, is adjusted to the
/// wanted error: when the candidate is measured for the first time, and when it is measured again. Chosen.
constexpr int kMostFirstTrials = 6;
constexpr int kMostTrials = 2;

/// A candidate that costs this many times as much as another candidate is not measured any further. Chosen.
constexpr double kHopelessCostRatio = 3.0;

/// Number of force evaluations that a candidate may take for the interval in the first round of trials. The number is
/// doubled until a candidate completes the interval. Chosen.
constexpr double kFirstEvaluations = 16.0;

/// The longest pause after a costly error estimate, in intervals. Chosen.
constexpr double kLongestCostPause = 64.0;

/// Velocity that the implicit steppers' solver may leave out, as a share of the wanted error divided by kErrorHorizon.
/// Chosen: small compared with the error of the step itself.
constexpr double kSolverShare = 0.2;

/// Intervals until the next error estimate while the step has not settled or has just changed. Chosen.
constexpr std::uint64_t kShortPause = 2;

AutoChoice& choiceOf(Simulation& simulation, StepperKind stepper) {
    return simulation.automatic.choices[static_cast<std::size_t>(stepper)];
}

bool isSettled(double ratio) {
    return std::max(ratio, 1.0 / ratio) < kSettledRatio;
}

/// Sets the step (s) of a candidate, and its cost at this step, which follows from a trial run.
void fit(AutoChoice& choice, const Trial& trial, double step, double interval) {
    choice.step = std::clamp(step, kShortestStep, interval);
    choice.cost = costAt(trial, choice.step);
}

/// Sets the step of a candidate to the step at which a trial run predicts the wanted error.
void choose(AutoChoice& choice, const Trial& trial, double wantedError, double interval) {
    const double wanted = wantedStep(trial, wantedError);
    fit(choice, trial, wanted, interval);
    choice.reason = trial.restriction && wanted >= trial.step ? *trial.restriction
                    : wanted >= interval                      ? StepLimit::frame
                                                              : StepLimit::error;
}

/// Cost of the cheapest candidate measured so far, in force evaluations per second of motion.
double cheapestCost(const Simulation& simulation) {
    double least = std::numeric_limits<double>::infinity();
    for (const AutoChoice& choice : simulation.automatic.choices) least = std::min(least, choice.cost);
    return least;
}

/// Sets the tolerance of the implicit steppers' solver. To be called before a run with the candidate.
void setSolverTolerance(Simulation& simulation, const AutoChoice& choice) {
    simulation.cache->toleratedAcceleration = acceptableResidual(simulation) / std::max(1.0, choice.growth);
}

/// Measures error and cost of a candidate by trial runs and updates its step. Trials are repeated while the step must
/// become much shorter and, at the candidate's first measurement, until the step has settled. They end early if the
/// candidate costs far more than another candidate or exceeds the allowed number of force evaluations.
Trial measureCandidate(Simulation& simulation, double time, StepperKind stepper, double mostEvaluations,
                       Simulation* finer) {
    AutoChoice& choice = choiceOf(simulation, stepper);
    const double interval = time - simulation.time;
    const double wantedError = simulation.setup.error / choice.growth;
    const auto runTrial = [&] {
        const Trial trial = measure(simulation, {time, stepper, choice.step, kErrorHorizon, mostEvaluations}, finer);
        simulation.automatic.estimateCost += trial.spent;
        if (!trial.finished) {  // step and cost are unknown
            choice.step = 0.0;
            choice.cost = std::numeric_limits<double>::infinity();
        }
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

/// Index of the cheapest candidate in kCandidates.
std::size_t cheapest(Simulation& simulation) {
    const auto best = std::min_element(kCandidates.begin(), kCandidates.end(), [&](StepperKind a, StepperKind b) {
        return choiceOf(simulation, a).cost < choiceOf(simulation, b).cost;
    });
    return static_cast<std::size_t>(best - kCandidates.begin());
}

/// Records, for the report, the error that a trial run predicts for the step in use.
void recordEstimate(AutoState& state, const Trial& trial) {
    const AutoChoice& choice = state.choices[static_cast<std::size_t>(trial.stepper)];
    const double ratio = stepRatioTo(trial, choice.step);
    const double error = trial.error * errorRatio(trial.stepper, ratio) * choice.growth;
    ++state.estimateCount;
    state.errorSum += error;
    state.largestError = std::max(state.largestError, error);
}

/// Replaces the simulation by the finer run of a trial, but keeps what is known of the candidates.
void continueFrom(Simulation& simulation, Simulation&& finer) {
    StepStatistics steps = simulation.steps;
    steps += finer.steps;
    const AutoState automatic = simulation.automatic;
    simulation = std::move(finer);
    simulation.automatic = automatic;
    simulation.steps = steps;
}

/// The trial of a candidate and the end state of its finer run, from which the simulation may continue.
struct MeasuredCandidate {
    Trial trial;
    Simulation finer;
};

/// Measures how the errors of a candidate grow beyond one interval, and adapts the candidate's step to this growth.
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
    // The previous growth counts as much as the new one, because a single collision may fall into this estimate by
    // chance.
    const double likely = std::clamp(seen, kLeastGrowth, kMostGrowth);
    const double growth = choice.followed ? std::sqrt(choice.growth * likely) : likely;
    fit(choice, far.trial, far.step * stepRatio(near.stepper, seen / growth), interval);
    choice.growth = growth;
    choice.followed = true;
}

/// Measures the error growth beyond one interval for the cheapest candidate, and repeats this with the candidate that
/// is then the cheapest, until the cheapest candidate is one whose growth has been measured. Without this a stepper
/// near its limit of stability may seem cheap over one interval. If a candidate's errors are found to be damped, the
/// errors of candidates whose growth was never measured are assumed to be damped, too.
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

/// Number of intervals to run before the next error estimate. Except after the first estimate, they must cost at least
/// as much as the estimate did.
std::uint64_t pauseAfter(std::uint64_t estimateCount, bool isSteady, double estimateIntervals) {
    const std::uint64_t pause = isSteady ? std::min(kLongestPause, 2 * estimateCount) : kShortPause;
    if (estimateCount == 1) return pause;
    return std::max(pause, static_cast<std::uint64_t>(std::min(kLongestCostPause, estimateIntervals)));
}

/// Measures all candidates, beginning with the stepper in use, and how the errors of the cheapest candidates grow
/// beyond the interval. Returns the candidate that is the cheapest in the end.
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

/// Runs the interval up to the given time (s) with an error estimate, chooses the step and, at every
/// kEstimatesPerComparison-th estimate, the stepper, and continues from the finer run.
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
    // The run continues from the finer run, whose cost is therefore not extra.
    state.estimateCost -= forceEvaluationsOf(measured.finer);
    const AutoChoice& choice = choiceOf(simulation, trial.stepper);
    recordEstimate(state, trial);
    // A single collision that needs a much shorter step must not determine the step of many frames.
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

/// Smallest radius of the particles, m. There must be at least one particle.
double smallestRadius(const Particles& particles) {
    return *std::min_element(particles.radius.begin(), particles.radius.end());
}

/// Whether the motion since a saved state differs much from the motion at the last error estimate, for example after an
/// impact.
bool hasMotionChanged(const Simulation& simulation, const SavedState& before) {
    // Accelerations too small to cause the wanted error do not count.
    const double least =
        simulation.setup.error * smallestRadius(simulation.particles) / (simulation.time - before.time);
    return rmsAccelerationSince(simulation, before) >
           kSurprisingGrowth * std::max(simulation.automatic.rmsAcceleration, least);
}

/// Whether the stored step, cost and growth of a candidate are possible values; NaNs are not.
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
