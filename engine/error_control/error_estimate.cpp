// Runs the same interval twice from one state and compares the ends.
#include "engine/error_control/error_estimate.h"

#include <algorithm>
#include <cmath>

#include "engine/error_control/checked_steps.h"
#include "engine/error_control/step_cost.h"
#include "engine/stepping/step_cache.h"
#include "engine/stepping/steppers.h"
#include "engine/stepping/symplectic_euler.h"

namespace engine {
namespace {

/// Chosen: the least share of the first run's error by which the two runs are taken to differ. Their steps can differ
/// by less than they were asked to where the audit has shortened both.
constexpr double kLeastContrast = 0.3;

/// Chosen: the largest factor by which one measurement changes a step. Further away the error no longer goes like a
/// power of the step.
constexpr double kMostChange = 3.0;

/// Runs the simulation to the end of the trial in steps no longer than `step` (s); returns whether it got there.
bool run(Simulation& simulation, const TrialRun& trialRun, double step, double mostEvaluations) {
    if (simulation.stepper != trialRun.stepper) {
        simulation.stepper = trialRun.stepper;
        simulation.cache->energy.reset();  // steppers know it at different moments of a step
        simulation.restriction = {};
    }
    simulation.steps = {};
    if (trialRun.stepper != StepperKind::symplecticEuler)
        return advanceChecked(simulation, trialRun.time, step, StepLimit::error, mostEvaluations);
    simulation.setup.step = step;
    // Unlike advance(), this removes no particles: the two runs are compared particle by particle.
    advanceInEqualSteps(simulation, trialRun.time);
    return true;
}

/// RMS of dx + T dv over the particles that were there at the start, in radii; T is the horizon, s.
double difference(const Particles& a, const Particles& b, std::size_t count, double horizon) {
    double sumSq = 0.0;
    for (std::size_t p = 0; p < count; ++p) {
        const Vec3 apart = a.position[p] - b.position[p] + horizon * (a.velocity[p] - b.velocity[p]);
        sumSq += squaredLength(apart) / (a.radius[p] * a.radius[p]);
    }
    return count == 0 ? 0.0 : std::sqrt(sumSq / static_cast<double>(count));
}

}  // namespace

Trial measure(const Simulation& simulation, const TrialRun& trialRun, Simulation* finer) {
    const double interval = trialRun.time - simulation.time;
    Trial trial;
    trial.stepper = trialRun.stepper;
    // One run after the other in the same memory, so that an estimate holds one simulation more and not two.
    Simulation there = simulation;
    trial.finished = run(there, trialRun, trialRun.step, trialRun.mostEvaluations);
    trial.spent = forceEvaluationsOf(there);
    if (!trial.finished) return trial;
    const auto meanStep = [&] { return interval / static_cast<double>(there.steps.count); };
    trial.asked = interval / stepCount(interval, trialRun.step);
    trial.step = meanStep();
    trial.cost = forceEvaluationsOf(there) / interval;
    trial.restricted = there.steps.rejected > 0 || there.restriction.seconds < trialRun.step;
    if (trial.restricted) trial.reason = there.restriction.reason;
    const Particles coarse = std::move(there.particles);
    there = simulation;
    // Half the steps that the first run took, which the audit and emissions may have shortened.
    run(there, trialRun, 0.5 * trial.step, std::numeric_limits<double>::infinity());
    const double contrast = std::max(kLeastContrast, 1.0 - errorRatio(trialRun.stepper, meanStep() / trial.step));
    const std::size_t count = simulation.particles.count();
    trial.error = difference(coarse, there.particles, count, trialRun.horizon) / contrast / interval;
    trial.spent += forceEvaluationsOf(there);
    if (finer == nullptr) return trial;
    *finer = std::move(there);
    finer->cache->implicit = {};  // its memory is large, and several may be kept
    return trial;
}

double wantedStep(const Trial& trial, double wanted) {
    const double change = trial.error > 0.0 ? stepRatio(trial.stepper, wanted / trial.error) : kMostChange;
    // Steps that the audit kept from growing will not grow for a larger error either; those that emissions ended may.
    if (trial.restricted || change < 1.0) return trial.step * std::clamp(change, 1.0 / kMostChange, 1.0);
    return trial.asked * std::min(change, kMostChange);
}

double stepRatioTo(const Trial& trial, double step) {
    return step / (step > trial.step ? trial.asked : trial.step);
}

double costAt(const Trial& trial, double step) {
    if (trial.restricted) return trial.cost / stepRatioTo(trial, step);
    const double endedEarly = std::max(0.0, 1.0 / trial.step - 1.0 / trial.asked);  // 1/s
    return trial.cost * trial.step * (1.0 / step + endedEarly);
}

}  // namespace engine
