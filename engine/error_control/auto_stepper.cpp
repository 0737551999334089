// Costs are counted in force evaluations, never timed, so that a choice depends only on the states.
#include "engine/error_control/auto_stepper.h"

#include <algorithm>
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

/// The steppers among which the automatic stepper chooses. Leapfrog and the stepper that treats only damping
/// implicitly never cost a tenth less than the better of these.
constexpr StepperKind kExplicit = StepperKind::velocityVerlet;
constexpr StepperKind kImplicit = StepperKind::linearlyImplicit;

/// First step, in intervals. Chosen: the filter finds the right one within some steps.
constexpr double kFirstStep = 1.0 / 8.0;

/// First step of the implicit stepper, in mean steps of velocity Verlet. Chosen.
constexpr double kLongerImplicit = 3.0;

/// Pause after the first twin, in intervals; it is doubled after each twin up to kLongestPause. Chosen.
constexpr std::uint64_t kFirstPause = 16;

/// The next twin starts early if the step has become shorter by this factor since the last one. Chosen.
constexpr double kShorter = 0.5;

/// Pause after a candidate that did not cost less, in intervals. Chosen: a candidate costs at most what the run costs
/// in the time of a twin.
constexpr std::uint64_t kCandidatePause = 128;

/// Smallest difference of the run and a twin of its stepper, as a share of the run's own error, from which anything is
/// learned: a twin whose steps emissions or the audit have ended takes nearly the same ones. Chosen.
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

StepperKind otherThan(StepperKind stepper) {
    return stepper == kExplicit ? kImplicit : kExplicit;
}

/// Corrects the calibration of a stepper by a measured error and the mean estimate of the same steps.
void calibrate(StepControl& steps, double error, double estimate) {
    if (!(error > 0.0 && estimate > 0.0)) return;
    const double seen = std::clamp(error / estimate, kLeastCalibration, kMostCalibration);
    steps.calibration = steps.isCalibrated ? std::sqrt(seen * steps.calibration) : seen;
    steps.isCalibrated = true;
}

/// Learns from a twin of the stepper in use. Returns whether the error is far below the wanted one, as far as is known.
bool learnFromTwin(Simulation& simulation, const Comparison& compared) {
    const TwinRun& twin = simulation.automatic.twin;
    // The error of the twin is that of the run times `more`; their difference is that of the errors.
    const double more = errorRatio(twin.stepper, twin.step / compared.step);
    if (more - 1.0 < kLeastContrast) return true;
    const double error = compared.distance / (more - 1.0);
    calibrate(controlOf(simulation, twin.stepper), error, compared.estimate);
    return error < kFarBelow * simulation.setup.error;
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
    simulation.automatic.nextCandidate = simulation.automatic.intervalCount + kCandidatePause;
}

/// Decides when another stepper is tried: soon, where something else than the error limits the steps of velocity
/// Verlet; where the error does, not before that is known again.
void planCandidate(Simulation& simulation, bool isFarBelow) {
    AutoState& state = simulation.automatic;
    if (simulation.stepper != kExplicit) return;
    if (!isFarBelow)
        state.nextCandidate = std::max(state.nextCandidate, state.nextTwin + 1);
    else if (state.intervalCount >= state.nextCandidate)
        state.nextTwin = state.intervalCount + 1;
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
            planCandidate(simulation, learnFromTwin(simulation, compared));
    }
    state.twin = {};
}

/// Starts a twin if it is time for one.
void startTwin(Simulation& simulation, double interval) {
    AutoState& state = simulation.automatic;
    if (state.twin.exists) return;
    const StepControl& inUse = controlOf(simulation, simulation.stepper);
    const bool isShorter = inUse.step < kShorter * state.stepAtTwin;
    if (state.intervalCount < state.nextTwin && !isShorter) return;
    const bool isCandidate = state.twinCount > 0 && state.intervalCount >= state.nextCandidate;
    if (isCandidate) {
        StepControl& other = controlOf(simulation, otherThan(simulation.stepper));
        if (other.step == 0.0) other.step = std::min(interval, kLongerImplicit * inUse.step);
        const double perSecond = state.runCostPerSecond;
        state.nextCandidate = state.intervalCount + kCandidatePause;
        sendCandidate(simulation, otherThan(simulation.stepper), interval, perSecond);
    } else {
        sendTwin(simulation, interval);
    }
    state.stepAtTwin = inUse.step;
    const std::uint64_t doublings = std::min<std::uint64_t>(8, state.twinCount - 1);
    state.nextTwin = state.intervalCount + std::min(kLongestPause, kFirstPause << doublings);
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
    if (inUse != kExplicit && inUse != kImplicit) return false;
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
    constexpr double kAny = std::numeric_limits<double>::infinity();
    advanceChecked(simulation, time, interval, StepLimit::error, kAny, &errors);
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
