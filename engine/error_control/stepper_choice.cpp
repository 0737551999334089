// The order in which steppers are tried, and the judgement of their costs, which are counted in force evaluations and
// never timed, so that a choice depends only on the states.
#include "engine/error_control/stepper_choice.h"

#include <algorithm>
#include <array>

#include "engine/error_control/checked_steps.h"
#include "engine/error_control/step_control.h"
#include "engine/stepping/step_cache.h"
#include "engine/stepping/take_step.h"

namespace engine {
namespace {

/// The steppers among which the automatic stepper chooses. A run begins with velocity Verlet. The stepper that treats
/// only damping implicitly never costs a tenth less than the best of these.
constexpr std::array kCandidates{StepperKind::velocityVerlet, StepperKind::leapfrog, StepperKind::linearlyImplicit};

/// First step of the implicit stepper, in steps of an explicit one. Chosen.
constexpr double kLongerImplicit = 3.0;

/// Pause from one candidate to the next, in durations of a twin. Chosen: a candidate costs at most what the run costs
/// in the time of a twin.
constexpr std::uint64_t kCandidatePause = 30;

/// No other stepper is tried where an interval costs less, in force evaluations. Chosen: at least one step is taken in
/// an interval, and an implicit step costs about half of this.
constexpr double kLeastCost = 8.0;

/// Another stepper is taken if it costs less than this share of the stepper in use. Chosen.
constexpr double kWorthwhile = 0.8;

/// The stepper that is tried next. Leapfrog at most doubles a step that damping limits; the implicit stepper may take a
/// whole interval. So the implicit one is tried first where doubled steps would still cost more than kLeastCost.
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

}  // namespace

bool isCandidate(StepperKind stepper) {
    return std::ranges::find(kCandidates, stepper) != kCandidates.end();
}

bool areManySteps(const AutoState& state, double interval) {
    return state.runCostPerSecond * interval >= kLeastCost;
}

bool isCandidateDue(const Simulation& simulation, double interval) {
    const AutoState& state = simulation.automatic;
    return state.twinCount > 0 && state.intervalCount >= state.nextCandidate &&
           (state.isLimited || simulation.stepper != StepperKind::velocityVerlet) && areManySteps(state, interval);
}

void sendNextCandidate(Simulation& simulation, double interval) {
    AutoState& state = simulation.automatic;
    const StepperKind candidate = nextCandidate(simulation, interval);
    const double ratio = isVerlet(candidate) == isVerlet(simulation.stepper) ? 1.0
                         : isVerlet(candidate)                               ? 1.0 / kLongerImplicit
                                                                             : kLongerImplicit;
    const double step = ratio * controlOf(simulation, simulation.stepper).step;
    StepControl& steps = controlOf(simulation, candidate);
    steps.step = std::max(kShortestStep, std::min(interval, step));
    state.lastCandidate = candidate;
    sendCandidate(simulation, candidate, interval, state.runCostPerSecond);
    // Where something else than the error limits the steps, both others are tried, one after the other.
    state.isSecond = state.isLimited && !state.isSecond;
    state.nextCandidate = state.intervalCount + (state.isSecond ? 0 : kCandidatePause * twinIntervals(interval));
}

void judgeCandidate(Simulation& simulation, const Comparison& compared, double interval) {
    const TwinRun& twin = simulation.automatic.twin;
    if (!(compared.distance > 0.0)) return;
    constexpr double kMostChange = 3.0;  // beyond it the error no longer follows a power of the step; chosen
    const double longest = isEmitting(simulation, interval) ? 1.0 : kMostChange;  // emissions end steps, too
    const double change =
        std::clamp(stepRatio(twin.stepper, simulation.setup.error / compared.distance), 1.0 / kMostChange, longest);
    const double step = std::min(twin.step * change, interval);
    // Longer implicit steps are not cheaper per second of motion, because their matrix takes more products to solve.
    const double costRatio = isVerlet(twin.stepper) ? twin.step / step : std::max(1.0, twin.step / step);
    if (twin.cost * costRatio > kWorthwhile * compared.cost) return;
    StepControl& steps = controlOf(simulation, twin.stepper);
    steps = {.step = step, .calibration = 1.0};
    calibrate(steps, compared.distance, twin.estimate);
    simulation.stepper = twin.stepper;
    simulation.restriction = {};
    simulation.cache->energy.reset();  // steppers know the energy at different moments of a step
}

}  // namespace engine
