// Two runs from one state.
#include "engine/error_look.h"

#include <algorithm>
#include <cmath>

#include "engine/audited_steps.h"
#include "engine/step_cost.h"
#include "engine/steppers.h"

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
        simulation.energy.reset();  // steppers know it at different moments of a step
        simulation.restriction = {};
    }
    simulation.steps = {};
    if (look.stepper != StepperKind::symplecticEuler)
        return advanceAudited(simulation, look.time, step, StepLimit::error, mostPasses);
    simulation.setup.step = step;
    simulation.setup.world.reset();  // the two runs are compared particle by particle: nobody leaves them
    advance(simulation, look.time);
    return true;
}

/// rms of dx + T dv over the particles that were there at the start, in radii.
double difference(const Simulation& a, const Simulation& b, std::size_t count, double horizon) {
    double sumSq = 0.0;
    for (std::size_t p = 0; p < count; ++p) {
        const Vec3 apart = a.particles.position[p] - b.particles.position[p] +
                           horizon * (a.particles.velocity[p] - b.particles.velocity[p]);
        sumSq += squaredLength(apart) / (a.particles.radius[p] * a.particles.radius[p]);
    }
    return count == 0 ? 0.0 : std::sqrt(sumSq / static_cast<double>(count));
}

}  // namespace

Trial measure(const Simulation& simulation, const Look& look, Simulation* finer) {
    const double interval = look.time - simulation.time;
    Trial trial;
    trial.stepper = look.stepper;
    Simulation whole = simulation;
    trial.finished = run(whole, look, look.step, look.mostPasses);
    trial.spent = passesOf(whole);
    if (!trial.finished) return trial;
    const auto meanStep = [&](const Simulation& s) { return interval / static_cast<double>(s.steps.count); };
    // Where the audit or births shortened the steps of the first run, those of the second are half as long again.
    Simulation halves = simulation;
    run(halves, look, 0.5 * meanStep(whole), std::numeric_limits<double>::infinity());
    const double ratio = meanStep(halves) / meanStep(whole);
    const double contrast = std::max(kLeastContrast, 1.0 - errorShare(look.stepper, ratio));
    trial.asked = interval / std::ceil(interval / look.step * (1.0 - 1e-9));
    trial.step = meanStep(whole);
    trial.error = difference(whole, halves, simulation.particles.count(), look.horizon) / contrast / interval;
    trial.cost = passesOf(whole) / interval;
    trial.spent += passesOf(halves);
    trial.restricted = whole.steps.rejected > 0 || whole.restriction.seconds < look.step;
    if (trial.restricted) trial.reason = whole.restriction.reason;
    if (finer != nullptr) *finer = std::move(halves);
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
