// Looking, choosing, going on. Passes over all pairs are counted for everything, so that what hardly pays is left out.
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
static_assert(kRunsOfLook == kCandidates.size() + 1);

/// Chosen: every so many looks all candidates are compared.
constexpr std::uint64_t kLooksPerComparison = 5;

/// Chosen: an interval in which the acceleration has grown by this factor since the last look is run again, as a look.
constexpr double kSurprise = 2.0;

/// A change of less is not worth a different rounding of the interval; hunting is.
constexpr double kGoodEnough = 1.5;

/// Measured on the scenes of `globular study accuracy`: beyond these, growth tells of one event and not of the motion.
constexpr double kLeastGrowth = 0.5;
constexpr double kMostGrowth = 16.0;

/// Chosen: looks in a row at a candidate until its step has settled, the first time and later.
constexpr int kMostFirstLooks = 6;
constexpr int kMostLooks = 2;

/// Chosen: a candidate this much dearer than another is not followed any further.
constexpr double kHopeless = 3.0;

/// Chosen: passes over all pairs that a candidate may take over the interval, at first; twice as many where none gets
/// through with them.
constexpr double kFirstPasses = 16.0;

/// Chosen: no look is worth more intervals.
constexpr double kMostWorth = 64.0;

/// The solver may leave out the velocity that is this share of the wanted error in the time that a wrong velocity
/// counts. Chosen: small beside what the step itself may err by.
constexpr double kSolverShare = 0.2;

/// Chosen: intervals until the next look where a step has not settled, or has only just changed.
constexpr std::uint64_t kShortPause = 2;

AutoChoice& choiceOf(Simulation& simulation, StepperKind stepper) {
    return simulation.automatic.choices[static_cast<std::size_t>(stepper)];
}

bool isSettled(double share) {
    return std::max(share, 1.0 / share) < kGoodEnough;
}

/// Changes the step (s) of a choice, and the cost with it.
void fit(AutoChoice& choice, const Trial& trial, double step, double interval) {
    choice.step = std::clamp(step, kShortestStep, interval);
    choice.cost = costAt(trial, choice.step);
}

/// What a measurement makes of a choice.
void choose(AutoChoice& choice, const Trial& trial, double wantedError, double interval) {
    const double wanted = wantedStep(trial, wantedError);
    fit(choice, trial, wanted, interval);
    choice.reason = trial.restricted && wanted >= trial.step ? *trial.reason
                    : wanted >= interval                     ? StepLimit::frame
                                                             : StepLimit::error;
}

/// Of the candidates that have been looked at, passes over all pairs for a second of motion.
double cheapestCost(const Simulation& simulation) {
    double least = std::numeric_limits<double>::infinity();
    for (const AutoChoice& choice : simulation.automatic.choices) least = std::min(least, choice.cost);
    return least;
}

/// What is to be asked afresh next time.
void forget(AutoChoice& choice) {
    choice.step = 0.0;
    choice.cost = std::numeric_limits<double>::infinity();
}

/// To be called before a candidate runs.
void tolerate(Simulation& simulation, const AutoChoice& choice) {
    simulation.cache->toleratedAcceleration = acceptableResidual(simulation) / std::max(1.0, choice.growth);
}

/// Measures a candidate and updates what is known of it, again and again while its step has to become much shorter, the
/// first time until it has settled, or until it costs far more than another candidate does or than it may.
Trial look(Simulation& simulation, double time, StepperKind stepper, double mostPasses, Simulation* finer) {
    AutoChoice& choice = choiceOf(simulation, stepper);
    const double interval = time - simulation.time;
    const double wantedError = simulation.setup.error / choice.growth;
    const auto measured = [&] {
        const Trial trial = measure(simulation, {time, stepper, choice.step, kErrorHorizon, mostPasses}, finer);
        simulation.automatic.trials += trial.spent;
        if (!trial.finished) forget(choice);
        return trial;
    };
    tolerate(simulation, choice);
    const bool first = choice.step == 0.0;
    if (first) choice.step = 0.25 * interval;
    Trial trial = measured();
    if (!trial.finished) return trial;
    choose(choice, trial, wantedError, interval);
    for (int round = 1; round < (first ? kMostFirstLooks : kMostLooks); ++round) {
        const double share = shareOf(trial, choice.step);
        if (isSettled(share) || choice.step == interval || (share > 1.0 && !first)) break;
        if (choice.cost > kHopeless * cheapestCost(simulation)) break;
        const Trial before = trial;
        trial = measured();
        if (!trial.finished) break;
        if (share < 1.0 && trial.error > kWasted * before.error) {
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

/// Index of a candidate.
std::size_t cheapest(Simulation& simulation) {
    const auto best = std::min_element(kCandidates.begin(), kCandidates.end(), [&](StepperKind a, StepperKind b) {
        return choiceOf(simulation, a).cost < choiceOf(simulation, b).cost;
    });
    return static_cast<std::size_t>(best - kCandidates.begin());
}

void note(AutoState& state, const Trial& trial) {
    const AutoChoice& choice = state.choices[static_cast<std::size_t>(trial.stepper)];
    const double share = shareOf(trial, choice.step);
    const double error = trial.error * errorShare(trial.stepper, share) * choice.growth;
    ++state.looks;
    state.errorSum += error;
    state.largestError = std::max(state.largestError, error);
}

/// Replaces the simulation by the finer run of a look; what the look learned stays.
void goOnFrom(Simulation& simulation, Simulation&& finer) {
    StepStatistics steps = simulation.steps;
    steps.shortest = steps.count == 0 ? finer.steps.shortest : std::min(steps.shortest, finer.steps.shortest);
    steps.longest = std::max(steps.longest, finer.steps.longest);
    steps.count += finer.steps.count;
    for (std::size_t limit = 0; limit < kStepLimits; ++limit) steps.limitedBy[limit] += finer.steps.limitedBy[limit];
    for (std::size_t s = 0; s < steps.takenBy.size(); ++s) steps.takenBy[s] += finer.steps.takenBy[s];
    steps.forceEvaluations += finer.steps.forceEvaluations;
    steps.products += finer.steps.products;
    steps.rejected += finer.steps.rejected;
    const AutoState automatic = simulation.automatic;
    simulation = std::move(finer);
    simulation.automatic = automatic;
    simulation.steps = steps;
}

/// A candidate that was looked at, and the run that goes on from there.
struct Looked {
    Trial trial;
    Simulation finer;
};

/// Makes a candidate's choice fit what becomes of its errors after a while.
void heedFar(Simulation& simulation, double time, const Trial& near) {
    AutoState& state = simulation.automatic;
    const double interval = time - simulation.time;
    AutoChoice& choice = choiceOf(simulation, near.stepper);
    tolerate(simulation, choice);
    const FarLook far = lookFar(simulation, near.stepper, choice.step, interval);
    state.trials += far.spent;
    const double share = shareOf(near, far.step);
    const double nearError = near.error * errorShare(near.stepper, share);
    if (!(nearError > 0.0)) return;
    const double seen = simulation.setup.error / nearError;
    // What was known counts as much as the new: one birth or collision may happen to fall into this look.
    const double likely = std::clamp(seen, kLeastGrowth, kMostGrowth);
    const double growth = choice.followed ? std::sqrt(choice.growth * likely) : likely;
    fit(choice, far.trial, far.step * stepShare(near.stepper, seen / growth), interval);
    choice.growth = growth;
    choice.followed = true;
}

/// Follows the errors of the cheapest candidate, and of whoever is cheapest then, until the cheapest has been followed:
/// near its limit of stability a stepper may look cheap at one interval. What damps the errors of one is taken to damp
/// those of another too, as long as that one has never been followed.
void followCheapest(Simulation& simulation, double time, const std::array<Looked, kCandidates.size()>& looked) {
    std::array<bool, kCandidates.size()> followed{};
    for (std::size_t best = cheapest(simulation); !followed[best]; best = cheapest(simulation)) {
        followed[best] = true;
        heedFar(simulation, time, looked[best].trial);
        const double growth = choiceOf(simulation, kCandidates[best]).growth;
        for (std::size_t c = 0; c < kCandidates.size(); ++c) {
            AutoChoice& other = choiceOf(simulation, kCandidates[c]);
            if (other.followed || other.step == 0.0 || other.growth <= growth) continue;
            fit(other, looked[c].trial, other.step * stepShare(kCandidates[c], other.growth / growth),
                time - simulation.time);
            other.growth = growth;
        }
    }
}

/// Intervals to run before the next look: a look must not cost more than they do, but for the first.
std::uint64_t pauseAfter(std::uint64_t looks, bool isSteady, double lookIntervals) {
    const std::uint64_t pause = isSteady ? std::min(kLongestPause, 2 * looks) : kShortPause;
    if (looks == 1) return pause;
    return std::max(pause, static_cast<std::uint64_t>(std::min(kMostWorth, lookIntervals)));
}

/// Looks at all candidates, the one in use first, and at what becomes of the errors of the cheapest; returns the one
/// that is the cheapest then.
Looked compare(Simulation& simulation, double time) {
    AutoState& state = simulation.automatic;
    const double interval = time - simulation.time;
    const AutoChoice& inUse = choiceOf(simulation, simulation.stepper);
    double most = std::max(kFirstPasses, inUse.step > 0.0 ? kHopeless * inUse.cost * interval : 0.0);
    for (AutoChoice& choice : state.choices) choice.cost = std::numeric_limits<double>::infinity();
    std::array<Looked, kCandidates.size()> looked;
    std::array<std::size_t, kCandidates.size()> order{};
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_partition(order.begin(), order.end(),
                          [&](std::size_t c) { return kCandidates[c] == simulation.stepper; });
    for (; std::isinf(cheapestCost(simulation)); most *= 2.0)
        for (const std::size_t c : order) {
            const double mostNow = std::min(most, kHopeless * cheapestCost(simulation) * interval);
            looked[c].trial = look(simulation, time, kCandidates[c], mostNow, &looked[c].finer);
        }
    followCheapest(simulation, time, looked);
    return std::move(looked[cheapest(simulation)]);
}

void lookAround(Simulation& simulation, double time) {
    AutoState& state = simulation.automatic;
    const double interval = time - simulation.time;
    const double spentBefore = state.trials;
    const auto known = state.choices;
    Looked looked;
    if (state.looks % kLooksPerComparison == 0) {
        looked = compare(simulation, time);
    } else {
        constexpr double kAny = std::numeric_limits<double>::infinity();
        looked.trial = look(simulation, time, simulation.stepper, kAny, &looked.finer);
    }
    const Trial& trial = looked.trial;
    state.trials -= passesOf(looked.finer);  // the run goes on with these; they are not lost
    const AutoChoice& choice = choiceOf(simulation, trial.stepper);
    note(state, trial);
    // One collision that asks for a much shorter step must not set those of many frames.
    const double knownStep = known[static_cast<std::size_t>(trial.stepper)].step;
    const bool isSteady =
        isSettled(shareOf(trial, choice.step)) && (knownStep == 0.0 || isSettled(choice.step / knownStep));
    state.nextLook =
        state.intervals + pauseAfter(state.looks, isSteady, (state.trials - spentBefore) / (choice.cost * interval));
    goOnFrom(simulation, std::move(looked.finer));
}

/// rms over the particles of the mean acceleration since `before`, gravity left out, in m/s^2.
double agitationSince(const Simulation& simulation, const BeforeStep& before) {
    const std::size_t count = before.velocity.size();
    const double duration = simulation.time - before.time;
    const Vec3 fall = duration * simulation.setup.gravity;
    const double sumSq = sumOver(count, [&](std::size_t p) {
        return squaredLength(simulation.particles.velocity[p] - before.velocity[p] - fall);
    });
    return std::sqrt(sumSq / static_cast<double>(count)) / duration;
}

/// Of some.
double smallestRadius(const Particles& particles) {
    return *std::min_element(particles.radius.begin(), particles.radius.end());
}

/// Whether something happened that the last look did not know of, such as an impact.
bool isSurprised(const Simulation& simulation, const BeforeStep& before) {
    // Changes of velocity below the wanted error matter to nobody.
    const double least =
        simulation.setup.error * smallestRadius(simulation.particles) / (simulation.time - before.time);
    return agitationSince(simulation, before) > kSurprise * std::max(simulation.automatic.agitation, least);
}

/// Whether a choice is one; a NaN is not.
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
           (isKnown || state.intervals >= state.nextLook) && state.agitation >= 0.0;
}

void advanceAutomatically(Simulation& simulation, double time) {
    emitDue(simulation);
    const AutoState& state = simulation.automatic;
    if (simulation.particles.count() == 0) {
        simulation.cache->toleratedAcceleration = 0.0;  // of particles that are no more
        advanceAudited(simulation, time, time - simulation.time, StepLimit::frame);
        return;
    }
    BeforeStep before;
    keep(simulation, before);
    bool looks = state.intervals >= state.nextLook;
    if (!looks) {
        const AutoChoice& choice = choiceOf(simulation, simulation.stepper);
        tolerate(simulation, choice);
        advanceAudited(simulation, time, choice.step, choice.reason);
        looks = isSurprised(simulation, before);
        if (looks) takeBack(simulation, before);
    }
    if (looks) {
        lookAround(simulation, time);
        simulation.automatic.agitation = agitationSince(simulation, before);
    }
    ++simulation.automatic.intervals;
}

}  // namespace engine
