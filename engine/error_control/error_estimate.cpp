// The error estimate: runs the same interval twice from one state and compares the end states.
#include "engine/error_control/error_estimate.h"

#include <algorithm>
#include <cmath>

#include "engine/error_control/checked_steps.h"
#include "engine/error_control/equal_steps.h"
#include "engine/error_control/step_cost.h"
#include "engine/ranks/exact_sums.h"
#include "engine/stepping/step_cache.h"
#include "engine/stepping/take_step.h"

namespace engine {
namespace {

/// Smallest value that is assumed for 1 - (h'/h)^p, the difference of the two runs over the error of the first. The
/// ratio h'/h of their mean steps is near 1 where the check of energy has shortened the steps of both. Chosen.
constexpr double kLeastContrast = 0.3;

/// Runs the simulation to the end of the trial in steps no longer than `step` (s); returns whether it reached the end.
bool run(Simulation& simulation, const TrialRun& trialRun, double step, double mostEvaluations) {
    if (simulation.stepper != trialRun.stepper) {
        simulation.stepper = trialRun.stepper;
        simulation.cache->energy.reset();  // steppers know the energy at different moments of a step
        simulation.restriction = {};
    }
    simulation.steps = {};
    if (trialRun.stepper != StepperKind::symplecticEuler)
        return advanceChecked(simulation, trialRun.time, step, StepLimit::error, mostEvaluations);
    simulation.setup.step = step;
    // Unlike advance(), this function removes no particles, because the two runs are compared particle by particle.
    advanceInEqualSteps(simulation, trialRun.time);
    return true;
}

/// RMS of dx + T dv over the first `count` particles, in radii, where dx and dv are the differences of positions and
/// velocities and T is kErrorHorizon.
double difference(const Ranks& ranks, const Particles& a, const Particles& b, std::size_t count) {
    const double sumSq = exactSum(ranks, count, [&](std::size_t p) {
        const Vec3 apart = a.position[p] - b.position[p] + kErrorHorizon * (a.velocity[p] - b.velocity[p]);
        return squaredLength(apart) / (a.radius[p] * a.radius[p]);
    });
    const std::uint64_t all = sumOfAll(ranks, count);
    return all == 0 ? 0.0 : std::sqrt(sumSq / static_cast<double>(all));
}

}  // namespace

Trial measure(const Simulation& simulation, const TrialRun& trialRun) {
    const double interval = trialRun.time - simulation.time;
    Trial trial;
    // One run after the other in the same memory, so that an estimate holds one simulation more and not two.
    Simulation there = simulation;
    trial.finished = run(there, trialRun, trialRun.step, trialRun.mostEvaluations);
    trial.spent = forceEvaluationsOf(there);
    if (!trial.finished) return trial;
    const auto meanStep = [&] { return interval / static_cast<double>(there.steps.count); };
    trial.step = meanStep();
    const Particles coarse = std::move(there.particles);
    there = simulation;
    // The second run takes half the mean step of the first run, whose steps may have been shortened by rejections and
    // for emissions.
    trial.finished = run(there, trialRun, 0.5 * trial.step, trialRun.mostOfFiner);
    trial.spent += forceEvaluationsOf(there);
    if (!trial.finished) return trial;
    const double contrast = std::max(kLeastContrast, 1.0 - errorRatio(trialRun.stepper, meanStep() / trial.step));
    const std::size_t count = simulation.particles.count();
    trial.error = difference(*simulation.ranks, coarse, there.particles, count) / contrast / interval;
    return trial;
}

}  // namespace engine
