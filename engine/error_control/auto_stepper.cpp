// Costs are counted in force evaluations, never timed, so that a choice depends only on the states.
#include "engine/error_control/auto_stepper.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/error_control/checked_steps.h"
#include "engine/error_control/error_estimate.h"
#include "engine/error_control/step_control.h"
#include "engine/error_control/step_cost.h"
#include "engine/error_control/stepper_choice.h"
#include "engine/error_control/twin.h"
#include "engine/stepping/population.h"
#include "engine/stepping/step_cache.h"
#include "engine/stepping/take_step.h"

namespace engine {
namespace {

constexpr double kAnyCost = std::numeric_limits<double>::infinity();

/// First step, in intervals. Chosen: the filter finds the right one within some steps.
constexpr double kFirstStep = 1.0 / 8.0;

/// Pause from the start of the first twin to that of the second, in durations of a twin. It is doubled after every
/// twin, candidates included, up to kLongestPause. Chosen.
constexpr std::uint64_t kFirstPause = 2;

/// Pause before a twin that starts early, in durations of a twin. Chosen.
constexpr std::uint64_t kShortestPause = 2;

/// The next twin starts early if an interval costs more, by this factor, than one did when the last twin started.
/// Chosen.
constexpr double kCostlier = 2.0;

/// A twin may cost as much as the run does at present, and this many times as much if particles are emitted meanwhile,
/// because emissions end its steps, too, and new particles make the run dearer. Chosen.
constexpr double kCostOfEmissions = 2.0;

/// Smallest difference of the estimates of the run and of a twin of its stepper, as a share of the run's, from which
/// anything is learned: a twin whose steps emissions or the audit have ended takes nearly the same ones. Chosen.
constexpr double kLeastContrast = 0.3;

/// Something else than the error limits the steps if the error is below this share of the wanted one, and below this
/// share of the estimate: the estimate is then that of vibrations which stiff damping or forces excite. Chosen.
constexpr double kFarBelow = 0.5;
constexpr double kOverestimated = 0.25;

/// Acceleration that the implicit steppers' solver may leave out, as a share of the wanted error divided by
/// kErrorHorizon.
/// Chosen: small compared with the error of the step itself.
constexpr double kSolverShare = 0.2;

/// Learns from a twin of the stepper in use.
void learnFromTwin(Simulation& simulation, const Comparison& compared, double interval) {
    AutoState& state = simulation.automatic;
    // The errors of the two are to each other as their estimates, and the distance between them is the difference.
    const double contrast = state.twin.estimate / compared.estimate - 1.0;
    state.isLimited = areManySteps(state, interval);
    if (!(contrast >= kLeastContrast)) return;
    const double error = compared.distance / contrast;
    calibrate(controlOf(simulation, simulation.stepper), error, compared.estimate);
    const bool isOverestimated = error < kOverestimated * compared.estimate;
    state.isLimited = isOverestimated && error < kFarBelow * simulation.setup.error && areManySteps(state, interval);
}

/// Learns from the twin if the run has got to its end.
void finishTwin(Simulation& simulation, double interval) {
    AutoState& state = simulation.automatic;
    if (!state.twin.exists || simulation.time < state.twin.end - kSameMoment) return;
    if (simulation.time <= state.twin.end + kSameMoment) {
        const Comparison compared = compareWithTwin(simulation);
        if (state.twin.stepper != simulation.stepper)
            judgeCandidate(simulation, compared, interval);
        else
            learnFromTwin(simulation, compared, interval);
    }
    state.twin = {};
}

/// Starts a twin if it is time for one.
void startTwin(Simulation& simulation, double interval) {
    AutoState& state = simulation.automatic;
    if (state.twin.exists) return;
    const std::uint64_t duration = twinIntervals(interval);
    const bool isCostlier = state.runCostPerSecond > kCostlier * state.costAtTwin &&
                            state.intervalCount >= state.lastTwin + kShortestPause * duration;
    const bool isCandidate = isCandidateDue(simulation, interval);
    if (state.intervalCount < state.nextTwin && !isCostlier && !(isCandidate && state.isLimited)) return;
    if (isCandidate) {
        sendNextCandidate(simulation, interval);
    } else {
        const double most = state.twinCount == 0 ? kAnyCost : state.runCostPerSecond;
        const bool hasEmissions = isEmitting(simulation, interval);
        sendTwin(simulation, interval, hasEmissions ? kCostOfEmissions * most : most);
        state.isLimited = !state.twin.exists && areManySteps(state, interval);
    }
    state.lastTwin = state.intervalCount;
    state.costAtTwin = state.runCostPerSecond;
    const std::uint64_t doublings = std::min<std::uint64_t>(8, state.twinCount - 1);
    state.nextTwin = state.intervalCount + duration * std::min(kLongestPause, kFirstPause << doublings);
}

/// Smallest radius of the particles, m. There must be at least one particle.
double smallestRadius(const Simulation& simulation) {
    double smallest = std::numeric_limits<double>::infinity();
    for (const double radius : simulation.particles.radius) smallest = std::min(smallest, radius);
    return -largestOfAll(*simulation.ranks, -smallest);
}

/// Whether the stored numbers of a twin are possible values; NaNs are not.
bool isPossible(const TwinRun& twin) {
    if (twin.position.size() != twin.id.size()) return false;
    const bool isFinite = std::isfinite(twin.step) && std::isfinite(twin.cost) && std::isfinite(twin.estimate);
    return !twin.exists || (isCandidate(twin.stepper) && isFinite && twin.start < twin.end &&
                            twin.step >= kShortestStep && twin.cost > 0.0);
}

}  // namespace

double acceptableResidual(const Simulation& simulation) {
    return kSolverShare * simulation.setup.error * smallestRadius(simulation) / kErrorHorizon;
}

bool isReachable(const AutoState& state, StepperKind inUse) {
    if (!isCandidate(inUse) || !isCandidate(state.lastCandidate)) return false;
    return std::ranges::all_of(state.controls, [](const StepControl& steps) { return isPossible(steps); }) &&
           isPossible(state.twin);
}

void advanceAutomatically(Simulation& simulation, double time) {
    emitDue(simulation);
    AutoState& state = simulation.automatic;
    const double interval = time - simulation.time;
    if (countOfAll(simulation) == 0) {
        simulation.cache->toleratedAcceleration = 0.0;
        advanceChecked(simulation, time, interval, StepLimit::frame);
        return;
    }
    StepControl& first = controlOf(simulation, simulation.stepper);
    if (first.step == 0.0) first.step = kFirstStep * interval;
    simulation.cache->toleratedAcceleration = acceptableResidual(simulation);
    startTwin(simulation, interval);
    const double costBefore = forceEvaluationsOf(simulation);
    ErrorControl errors{controlOf(simulation, simulation.stepper), simulation.setup.error};
    advanceChecked(simulation, time, interval, StepLimit::error, kAnyCost, &errors);
    controlOf(simulation, simulation.stepper) = errors.steps;
    state.twin.runEstimate += errors.estimate;
    state.runCostPerSecond = (forceEvaluationsOf(simulation) - costBefore) / interval;
    const double error = errors.steps.calibration * errors.estimate / interval;
    state.errorSum += error;
    state.largestError = std::max(state.largestError, error);
    finishTwin(simulation, interval);
    ++state.intervalCount;
}

}  // namespace engine
