// Looking, choosing, going on.
#include "engine/auto_stepper.h"

#include <algorithm>
#include <cmath>

#include "engine/audited_steps.h"
#include "engine/error_look.h"
#include "engine/parallel.h"
#include "engine/step_audit.h"
#include "engine/steppers.h"

namespace engine {
namespace {

constexpr std::array kCandidates = {StepperKind::velocityVerlet, StepperKind::implicitDamping,
                                    StepperKind::linearlyImplicit};

/// Chosen: every so many looks all candidates are compared.
constexpr std::uint64_t kLooksPerComparison = 5;

/// Chosen: an interval in which the acceleration has grown by this factor since the last look is run again, as a look.
constexpr double kSurprise = 2.0;

/// One look changes the step by at most this factor; further away the error no longer goes like its square.
constexpr double kMostChange = 3.0;

/// A change of less is not worth a different rounding of the interval; hunting is.
constexpr double kGoodEnough = 1.5;

/// Chosen: intervals over which the growth of errors is measured: as long as a collision or the time between births.
constexpr double kFarLook = 4.0;

/// Measured on the scenes of `globular study accuracy`: beyond these, growth tells of one event and not of the motion.
constexpr double kLeastGrowth = 0.6;
constexpr double kMostGrowth = 2.5;

/// Chosen: looks in a row at a candidate until its step has settled, the first time and later.
constexpr int kMostFirstLooks = 6;
constexpr int kMostLooks = 2;

/// Steps at least 1.5 times shorter should err 2.2 times less. Where they err more than this share, something else than
/// the step makes the error, such as the sweep past an obstacle, and shorter ones are wasted.
constexpr double kWasted = 0.7;

/// Chosen: a candidate this much dearer than another is not followed to where its step settles.
constexpr double kHopeless = 3.0;

/// Chosen: no look is worth more intervals.
constexpr double kMostWorth = 64.0;

/// Chosen: intervals until the next look where a step has not settled.
constexpr std::uint64_t kShortPause = 2;

AutoChoice& choiceOf(Simulation& simulation, StepperKind stepper) {
    return simulation.automatic.choices[static_cast<std::size_t>(stepper)];
}

/// The step at which the measured error would be the wanted one, as far as the measurement reaches.
double wantedStep(const Trial& trial, double wanted) {
    const double change = trial.error > 0.0 ? std::sqrt(wanted / trial.error) : kMostChange;
    // Steps that the audit did not let grow will not grow for a better error either; those that births ended may.
    if (trial.restricted || change < 1.0) return trial.step * std::clamp(change, 1.0 / kMostChange, 1.0);
    return trial.asked * std::min(change, kMostChange);
}

/// What a step (s) of the candidate's is to those that were measured.
double shareOf(const Trial& trial, double step) {
    return step / (step > trial.step ? trial.asked : trial.step);
}

bool isSettled(double share) {
    return std::max(share, 1.0 / share) < kGoodEnough;
}

/// What a measurement makes of a choice.
void choose(AutoChoice& choice, const Trial& trial, double wantedError, double interval) {
    const double wanted = wantedStep(trial, wantedError);
    choice.step = std::clamp(wanted, kShortestStep, interval);
    choice.cost = trial.cost / shareOf(trial, choice.step);
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

/// Measures a candidate and updates what is known of it, again and again while its step has to become much shorter, the
/// first time until it has settled, or until it costs far more than another candidate does.
Trial look(Simulation& simulation, double time, StepperKind stepper, Simulation* finer) {
    AutoChoice& choice = choiceOf(simulation, stepper);
    const double interval = time - simulation.time;
    const double wantedError = simulation.setup.error / simulation.automatic.growth;
    const bool first = choice.step == 0.0;
    if (first) choice.step = 0.25 * interval;
    Trial trial = measure(simulation, time, stepper, choice.step, finer);
    simulation.automatic.trials += trial.spent;
    choose(choice, trial, wantedError, interval);
    for (int round = 1; round < (first ? kMostFirstLooks : kMostLooks); ++round) {
        const double share = shareOf(trial, choice.step);
        if (isSettled(share) || choice.step == interval || (share > 1.0 && !first)) break;
        if (choice.cost > kHopeless * cheapestCost(simulation)) break;
        const Trial before = trial;
        trial = measure(simulation, time, stepper, choice.step, finer);
        simulation.automatic.trials += trial.spent;
        if (share < 1.0 && trial.error > kWasted * before.error) {
            trial = before;
            choice = {before.asked, before.cost, StepLimit::error};
            break;
        }
        choose(choice, trial, wantedError, interval);
    }
    return trial;
}

StepperKind cheapest(Simulation& simulation) {
    return *std::min_element(kCandidates.begin(), kCandidates.end(), [&](StepperKind a, StepperKind b) {
        return choiceOf(simulation, a).cost < choiceOf(simulation, b).cost;
    });
}

void note(AutoState& state, const Trial& trial, double step) {
    const double share = shareOf(trial, step);
    const double error = trial.error * share * share * state.growth;
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

/// What an error made in one interval has become some intervals later, by damping or by collisions, is measured too,
/// and the choices are made to fit it.
void lookFar(Simulation& simulation, double time, const Trial& near) {
    AutoState& state = simulation.automatic;
    const AutoChoice& choice = choiceOf(simulation, near.stepper);
    const double interval = time - simulation.time;
    const double step = std::min(2.0 * choice.step, interval);  // cheaper, and the order is known
    const Trial far = measure(simulation, simulation.time + kFarLook * interval, near.stepper, step);
    state.trials += far.spent;
    const double share = shareOf(near, far.step);
    const double nearError = near.error * share * share;
    if (!(nearError > 0.0)) return;
    // What was known counts as much as the new: one birth or collision may happen to fall into this look.
    const double measured = std::clamp(far.error / nearError, kLeastGrowth, kMostGrowth);
    const double growth = state.looks == 0 ? measured : std::sqrt(state.growth * measured);
    const double change = std::sqrt(state.growth / growth);
    for (const StepperKind candidate : kCandidates) {
        AutoChoice& other = choiceOf(simulation, candidate);
        const double fitting = std::clamp(other.step * change, kShortestStep, interval);
        other.cost *= other.step / fitting;
        other.step = fitting;
    }
    state.growth = growth;
}

/// Intervals to run before the next look: a look must not cost more than they do, but for the first.
std::uint64_t pauseAfter(std::uint64_t looks, double spent, const Trial& trial, const AutoChoice& choice,
                         double interval) {
    const bool settled = isSettled(shareOf(trial, choice.step));
    const std::uint64_t pause = settled ? std::min(kLongestPause, 2 * looks) : kShortPause;
    if (looks == 1) return pause;
    const double worth = std::min(kMostWorth, spent / (choice.cost * interval));
    return std::max(pause, static_cast<std::uint64_t>(worth));
}

void lookAround(Simulation& simulation, double time) {
    AutoState& state = simulation.automatic;
    const double interval = time - simulation.time;
    const double spentBefore = state.trials;
    const bool compare = state.looks % kLooksPerComparison == 0;
    std::array<Simulation, kCandidates.size()> finer;
    std::array<Trial, kCandidates.size()> trials;
    for (std::size_t c = 0; c < kCandidates.size(); ++c)
        if (compare || kCandidates[c] == simulation.stepper)
            trials[c] = look(simulation, time, kCandidates[c], &finer[c]);
    const StepperKind best = compare ? cheapest(simulation) : simulation.stepper;
    const auto chosen =
        static_cast<std::size_t>(std::find(kCandidates.begin(), kCandidates.end(), best) - kCandidates.begin());
    if (compare) lookFar(simulation, time, trials[chosen]);
    state.trials -= passesOf(finer[chosen].steps);  // the run goes on with these; they are not lost
    const AutoChoice& choice = choiceOf(simulation, best);
    note(state, trials[chosen], choice.step);
    const double spent = state.trials - spentBefore;
    state.nextLook = state.intervals + pauseAfter(state.looks, spent, trials[chosen], choice, interval);
    goOnFrom(simulation, std::move(finer[chosen]));
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

/// Whether something happened that the last look did not know of, such as an impact.
bool isSurprised(const Simulation& simulation, const BeforeStep& before) {
    // Changes of velocity below the wanted error matter to nobody.
    const double least = simulation.setup.error * simulation.particles.radius[0] / (simulation.time - before.time);
    return agitationSince(simulation, before) > kSurprise * std::max(simulation.automatic.agitation, least);
}

/// Whether a choice is one; a NaN is not.
bool isChoice(const AutoChoice& choice) {
    const bool isUnknown = choice.step == 0.0;
    return (isUnknown || choice.step >= kShortestStep) && std::isfinite(choice.step) && choice.cost >= 0.0 &&
           static_cast<std::uint64_t>(choice.reason) < kStepLimits;
}

}  // namespace

bool isReachable(const AutoState& state, StepperKind inUse) {
    if (std::find(kCandidates.begin(), kCandidates.end(), inUse) == kCandidates.end()) return false;
    const bool isKnown = state.choices[static_cast<std::size_t>(inUse)].step > 0.0;
    return std::all_of(state.choices.begin(), state.choices.end(), isChoice) &&
           (isKnown || state.intervals >= state.nextLook) && state.growth >= kLeastGrowth &&
           state.growth <= kMostGrowth && state.agitation >= 0.0;
}

void advanceAutomatically(Simulation& simulation, double time) {
    giveBirth(simulation);
    const AutoState& state = simulation.automatic;
    if (simulation.particles.count() == 0)
        return advanceAudited(simulation, time, time - simulation.time, StepLimit::frame);
    BeforeStep before;
    keep(simulation, before);
    bool looks = state.intervals >= state.nextLook;
    if (!looks) {
        const AutoChoice& choice = choiceOf(simulation, simulation.stepper);
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
