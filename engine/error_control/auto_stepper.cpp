// Costs are counted in force evaluations, never timed, so that a choice depends only on the states.
#include "engine/error_control/auto_stepper.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/error_control/checked_steps.h"
#include "engine/error_control/error_estimate.h"
#include "engine/error_control/step_cost.h"
#include "engine/error_control/twin.h"
#include "engine/stepping/population.h"
#include "engine/stepping/step_cache.h"
#include "engine/stepping/take_step.h"

namespace engine {
namespace {

/// The steppers among which the automatic stepper chooses, in the order in which they are tried. A run begins with the
/// first. The stepper that treats only damping implicitly never costs a tenth less than the best of these.
constexpr std::array kCandidates{StepperKind::velocityVerlet, StepperKind::leapfrog, StepperKind::linearlyImplicit};

constexpr double kAnyCost = std::numeric_limits<double>::infinity();

/// First step, in intervals. Chosen: the filter finds the right one within some steps.
constexpr double kFirstStep = 1.0 / 8.0;

/// First step of the implicit stepper, in steps of an explicit one. Chosen.
constexpr double kLongerImplicit = 3.0;

/// Pauses from the start of a twin to that of the next, in durations of a twin: after the first, from which it is
/// doubled up to kLongestPause, and the least before a twin that starts early. Chosen.
constexpr std::uint64_t kFirstPause = 2;
constexpr std::uint64_t kShortestPause = 2;

/// The next twin starts early if an interval costs more, by this factor, than one did when the last twin started.
/// Chosen.
constexpr double kCostlier = 2.0;

/// A twin of the stepper in use is given up when it has cost more than the run does at present, by this factor where
/// particles are emitted: they end the steps of both, and make the run more costly. Chosen.
constexpr double kCostOfEmissions = 2.0;

/// Pause from one candidate to the next, in durations of a twin. Chosen: a candidate costs at most what the run costs
/// in the time of a twin.
constexpr std::uint64_t kCandidatePause = 15;

/// No other stepper is tried where an interval costs less, in force evaluations. Chosen: at least one step is taken in
/// an interval, and an implicit step costs about half of this.
constexpr double kLeastCost = 8.0;

/// Smallest difference of the estimates of the run and of a twin of its stepper, as a share of the run's, from which
/// anything is learned: a twin whose steps emissions or the audit have ended takes nearly the same ones. Chosen.
constexpr double kLeastContrast = 0.3;

/// The error is far below the wanted one if it is below this share of it, although the steps are as long as they can
/// be: something else than the error limits them. Chosen.
constexpr double kFarBelow = 0.25;

/// Another stepper is taken if it costs less than this share of the stepper in use. Chosen.
constexpr double kWorthwhile = 0.8;

/// Limits on calibrations. Measured: in the scenes of the library they lie between 0.05 and 10.
constexpr double kLeastCalibration = 0.1;
constexpr double kMostCalibration = 50.0;

/// Velocity that the implicit steppers' solver may leave out, as a share of the wanted error divided by kErrorHorizon.
/// Chosen: small compared with the error of the step itself.
constexpr double kSolverShare = 0.2;

StepControl& controlOf(Simulation& simulation, StepperKind stepper) {
    return simulation.automatic.controls[static_cast<std::size_t>(stepper)];
}

/// The stepper that is tried next. Steps that something else than the error limits get at most twice as long by
/// leapfrog, and as long as an interval by the implicit stepper.
StepperKind nextCandidate(const Simulation& simulation, double interval) {
    const AutoState& state = simulation.automatic;
    const auto notLast = [&](StepperKind first, StepperKind second) {
        return state.lastCandidate == first ? second : first;
    };
    switch (simulation.stepper) {
        case StepperKind::leapfrog:
            return state.isLimited ? StepperKind::linearlyImplicit : StepperKind::velocityVerlet;
        case StepperKind::linearlyImplicit:
            return notLast(StepperKind::leapfrog, StepperKind::velocityVerlet);
        default:
            break;
    }
    return state.runCostPerSecond * interval > 2.0 * kLeastCost
               ? notLast(StepperKind::linearlyImplicit, StepperKind::leapfrog)
               : notLast(StepperKind::leapfrog, StepperKind::linearlyImplicit);
}

/// Corrects the calibration of a stepper by a measured error and the mean estimate of the same steps. What comes next
/// may err more for the same estimate, for example an impact after a fall, and less is believed only by and by.
void calibrate(StepControl& steps, double error, double estimate) {
    if (!(error > 0.0 && estimate > 0.0)) return;
    constexpr double kLess = 1.0 / 4.0;
    constexpr double kMore = 16.0;
    const double seen = std::clamp(error / estimate, kLess * steps.calibration, kMore * steps.calibration);
    const double mean = steps.isCalibrated ? std::sqrt(seen * steps.calibration) : seen;
    steps.calibration = std::clamp(mean, kLeastCalibration, kMostCalibration);
    steps.isCalibrated = true;
}

/// Whether steps that the error does not limit are worth another stepper.
bool areManySteps(const AutoState& state, double interval) {
    return state.runCostPerSecond * interval >= kLeastCost;
}

/// Learns from a twin of the stepper in use.
void learnFromTwin(Simulation& simulation, const Comparison& compared, double interval) {
    AutoState& state = simulation.automatic;
    // The errors of the two are to each other as their estimates, and the distance between them is the difference.
    const double contrast = state.twin.estimate / compared.estimate - 1.0;
    state.isLimited = !state.twin.hasEmissions && areManySteps(state, interval);
    if (!(contrast >= kLeastContrast)) return;
    const double error = compared.distance / contrast;
    calibrate(controlOf(simulation, simulation.stepper), error, compared.estimate);
    state.isLimited = error < kFarBelow * simulation.setup.error && areManySteps(state, interval);
}

/// Takes the stepper of the twin if it costs less at the step with which it meets the wanted error.
void judgeCandidate(Simulation& simulation, const Comparison& compared, double interval) {
    const TwinRun& twin = simulation.automatic.twin;
    if (!(compared.distance > 0.0)) return;
    constexpr double kMostChange = 3.0;  // beyond it the error no longer follows a power of the step; chosen
    const double change =
        std::clamp(stepRatio(twin.stepper, simulation.setup.error / compared.distance), 1.0 / kMostChange, kMostChange);
    const double step = std::min(twin.step * change, interval);
    if (twin.cost * twin.step / step > kWorthwhile * compared.cost) return;
    StepControl& steps = controlOf(simulation, twin.stepper);
    steps = {.step = step, .calibration = 1.0};
    calibrate(steps, compared.distance, twin.estimate);
    simulation.stepper = twin.stepper;
    simulation.restriction = {};
    simulation.cache->energy.reset();  // steppers know the energy at different moments of a step
}

/// Whether the next twin is to be of another stepper. Velocity Verlet is left only where something else than the error
/// limits its steps.
bool isCandidateDue(const Simulation& simulation, double interval) {
    const AutoState& state = simulation.automatic;
    return state.twinCount > 0 && state.intervalCount >= state.nextCandidate &&
           (state.isLimited || simulation.stepper != kCandidates.front()) && areManySteps(state, interval);
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
        if (state.isLimited && isCandidateDue(simulation, interval)) state.nextTwin = state.intervalCount + 1;
    }
    state.twin = {};
}

/// Sends another stepper ahead.
void sendNextCandidate(Simulation& simulation, double interval) {
    AutoState& state = simulation.automatic;
    const StepperKind candidate = nextCandidate(simulation, interval);
    const double ratio = isVerlet(candidate) == isVerlet(simulation.stepper) ? 1.0
                         : isVerlet(candidate)                               ? 1.0 / kLongerImplicit
                                                                             : kLongerImplicit;
    controlOf(simulation, candidate).step = std::min(interval, ratio * controlOf(simulation, simulation.stepper).step);
    state.lastCandidate = candidate;
    sendCandidate(simulation, candidate, interval, state.runCostPerSecond);
}

/// Whether particles are emitted in the time that a twin lasts.
bool isEmitting(const Simulation& simulation, double interval) {
    return nextEmission(simulation) < simulation.time + interval * static_cast<double>(twinIntervals(interval));
}

/// Starts a twin if it is time for one.
void startTwin(Simulation& simulation, double interval) {
    AutoState& state = simulation.automatic;
    if (state.twin.exists) return;
    const std::uint64_t duration = twinIntervals(interval);
    const bool isCostlier = state.runCostPerSecond > kCostlier * state.costAtTwin &&
                            state.intervalCount >= state.lastTwin + kShortestPause * duration;
    if (state.intervalCount < state.nextTwin && !isCostlier) return;
    if (isCandidateDue(simulation, interval)) {
        sendNextCandidate(simulation, interval);
        // Where something else than the error limits the steps, both others are tried, one after the other.
        state.isSecond = state.isLimited && !state.isSecond;
        state.nextCandidate = state.intervalCount + (state.isSecond ? 0 : kCandidatePause * duration);
    } else {
        const double most = state.twinCount == 0 ? kAnyCost : state.runCostPerSecond;
        const bool hasEmissions = isEmitting(simulation, interval);
        sendTwin(simulation, interval, hasEmissions ? kCostOfEmissions * most : most);
        state.twin.hasEmissions = hasEmissions;
        state.isLimited = !state.twin.exists && !hasEmissions && areManySteps(state, interval);
    }
    state.lastTwin = state.intervalCount;
    state.costAtTwin = state.runCostPerSecond;
    const std::uint64_t doublings = std::min<std::uint64_t>(8, state.twinCount - 1);
    state.nextTwin = state.intervalCount + duration * std::min(kLongestPause, kFirstPause << doublings);
    if (!state.twin.exists && isCandidateDue(simulation, interval)) state.nextTwin = state.intervalCount + 1;
}

/// Smallest radius of the particles, m. There must be at least one particle.
double smallestRadius(const Particles& particles) {
    return *std::min_element(particles.radius.begin(), particles.radius.end());
}

/// Whether the stored numbers of a control are possible values; NaNs are not.
bool isPossible(const StepControl& steps) {
    const bool isUnused = steps.step == 0.0;
    return (isUnused || steps.step >= kShortestStep) && std::isfinite(steps.step) && steps.stepBefore >= 0.0 &&
           std::isfinite(steps.stepBefore) && steps.ratioBefore > 0.0 && steps.calibration >= kLeastCalibration &&
           steps.calibration <= kMostCalibration;
}

}  // namespace

double acceptableResidual(const Simulation& simulation) {
    return kSolverShare * simulation.setup.error * smallestRadius(simulation.particles) / kErrorHorizon;
}

bool isReachable(const AutoState& state, StepperKind inUse) {
    const auto isCandidate = [](StepperKind stepper) {
        return std::ranges::find(kCandidates, stepper) != kCandidates.end();
    };
    if (!isCandidate(inUse) || !isCandidate(state.lastCandidate)) return false;
    return std::ranges::all_of(state.controls, isPossible) && state.twin.position.size() == state.twin.id.size();
}

void advanceAutomatically(Simulation& simulation, double time) {
    emitDue(simulation);
    AutoState& state = simulation.automatic;
    const double interval = time - simulation.time;
    if (simulation.particles.count() == 0) {
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
    ++state.estimateCount;
    state.errorSum += error;
    state.largestError = std::max(state.largestError, error);
    finishTwin(simulation, interval);
    ++state.intervalCount;
}

}  // namespace engine
