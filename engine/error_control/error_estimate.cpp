// Two runs from one state.
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

/// Two runs whose mean steps differ by less tell nothing about the order; the audit shortened both.
constexpr double kLeastContrast = 0.3;

/// One measurement says at most that a step should change by this factor; further away the error no longer goes like
/// its power.
constexpr double kMostChange = 3.0;

/// Returns whether it got to the look's end.
bool run(Simulation& simulation, const Look& look, double step, double mostPasses) {
    if (simulation.stepper != look.stepper) {
        simulation.stepper = look.stepper;
        simulation.cache->energy.reset();  // steppers know it at different moments of a step
        simulation.restriction = {};
    }
    simulation.steps = {};
    if (look.stepper != StepperKind::symplecticEuler)
        return advanceAudited(simulation, look.time, step, StepLimit::error, mostPasses);
    simulation.setup.step = step;
    // Unlike advance(), this removes no particles: the two runs are compared particle by particle.
    advanceInEqualSteps(simulation, look.time);
    return true;
}

/// rms of dx + T dv over the particles that were there at the start, in radii.
double difference(const Particles& a, const Particles& b, std::size_t count, double horizon) {
    double sumSq = 0.0;
    for (std::size_t p = 0; p < count; ++p) {
        const Vec3 apart = a.position[p] - b.position[p] + horizon * (a.velocity[p] - b.velocity[p]);
        sumSq += squaredLength(apart) / (a.radius[p] * a.radius[p]);
    }
    return count == 0 ? 0.0 : std::sqrt(sumSq / static_cast<double>(count));
}

}  // namespace

Trial measure(const Simulation& simulation, const Look& look, Simulation* finer) {
    const double interval = look.time - simulation.time;
    Trial trial;
    trial.stepper = look.stepper;
    // One run after the other in the same memory: a look holds one simulation more, not two.
    Simulation there = simulation;
    trial.finished = run(there, look, look.step, look.mostPasses);
    trial.spent = passesOf(there);
    if (!trial.finished) return trial;
    const auto meanStep = [&] { return interval / static_cast<double>(there.steps.count); };
    trial.asked = interval / std::ceil(interval / look.step * (1.0 - 1e-9));
    trial.step = meanStep();
    trial.cost = passesOf(there) / interval;
    trial.restricted = there.steps.rejected > 0 || there.restriction.seconds < look.step;
    if (trial.restricted) trial.reason = there.restriction.reason;
    const Particles coarse = std::move(there.particles);
    there = simulation;
    // Where the audit or births shortened the steps of the first run, those of the second are half as long again.
    run(there, look, 0.5 * trial.step, std::numeric_limits<double>::infinity());
    const double contrast = std::max(kLeastContrast, 1.0 - errorShare(look.stepper, meanStep() / trial.step));
    const std::size_t count = simulation.particles.count();
    trial.error = difference(coarse, there.particles, count, look.horizon) / contrast / interval;
    trial.spent += passesOf(there);
    if (finer == nullptr) return trial;
    *finer = std::move(there);
    finer->cache->implicit = {};  // several may be kept
    return trial;
}

double wantedStep(const Trial& trial, double wanted) {
    const double change = trial.error > 0.0 ? stepShare(trial.stepper, wanted / trial.error) : kMostChange;
    // Steps that the audit did not let grow will not grow for a better error either; those that births ended may.
    if (trial.restricted || change < 1.0) return trial.step * std::clamp(change, 1.0 / kMostChange, 1.0);
    return trial.asked * std::min(change, kMostChange);
}

double shareOf(const Trial& trial, double step) {
    return step / (step > trial.step ? trial.asked : trial.step);
}

double costAt(const Trial& trial, double step) {
    if (trial.restricted) return trial.cost / shareOf(trial, step);
    const double endedEarly = std::max(0.0, 1.0 / trial.step - 1.0 / trial.asked);  // 1/s
    return trial.cost * trial.step * (1.0 / step + endedEarly);
}

}  // namespace engine
