// The loop of emission, a step and a verdict on it.
#include "engine/error_control/checked_steps.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/error_control/step_cost.h"
#include "engine/stepping/population.h"
#include "engine/stepping/state_checks.h"
#include "engine/stepping/step_audit.h"
#include "engine/stepping/step_cache.h"
#include "engine/stepping/steppers.h"

namespace engine {
namespace {

/// Chosen: accepted steps in a row before a longer one is tried again.
constexpr std::uint32_t kAcceptedBeforeLonger = 8;

/// Chosen: how many steps a run can go back. An accepted step may lead to a state from which no step is accepted.
constexpr std::size_t kHistory = 4;

/// Computes the energy of the present state, and the forces with it.
void establishEnergy(Simulation& simulation) {
    requireValid(simulation, 0.0);
    Particles& particles = simulation.particles;
    const double pairEnergy =
        simulation.cache->evaluator.evaluateFree(particles, particles.velocity, simulation.cache->forces);
    ++simulation.steps.forceEvaluations;
    simulation.cache->forcesCurrent = true;
    recordEnergy(simulation, pairEnergy);
}

/// The implicit steppers know the energy in the middle of a step only. The state at the end of an interval is seen by
/// others and never taken back, so the last step is also judged by the energy at its end.
void checkIntervalEnd(Simulation& simulation) {
    if (isVerlet(simulation.stepper) || std::isnan(*simulation.cache->energy)) return;
    if (!isValid(simulation.particles)) return markInvalid(simulation);
    establishEnergy(simulation);
}

/// The time at which the next step must end at the latest, s: the one that was asked for, or the next emission before
/// it, as otherwise a new particle would act on the others only from the start of the following step.
double nextStop(const Simulation& simulation, double time) {
    double stop = std::numeric_limits<double>::infinity();
    for (std::size_t e = 0; e < simulation.setup.emitters.size(); ++e)
        stop = std::min(stop, nextEmission(simulation.setup.emitters[e], simulation.emitters[e]));
    return stop < time - kSameMoment ? stop : time;
}

/// The states before the last few steps, the latest at the end.
class History {
 public:
    void add(const Simulation& simulation) {
        if (states_.size() == kHistory) std::rotate(states_.begin(), states_.begin() + 1, states_.end());
        if (states_.size() < kHistory) states_.emplace_back();
        save(simulation, states_.back());
    }

    const SavedState& latest() const { return states_.back(); }

    /// Restores the latest state, or the one before it where the latest has just been tried.
    void goBack(Simulation& simulation, bool further) {
        if (further && states_.size() > 1) states_.pop_back();
        restore(simulation, states_.back());
        states_.pop_back();
    }

 private:
    std::vector<SavedState> states_;
};

}  // namespace

bool advanceChecked(Simulation& simulation, double time, double longest, StepLimit reason, double mostEvaluations) {
    History history;
    int rejectedInRow = 0;
    emitDue(simulation);
    if (!simulation.cache->energy) establishEnergy(simulation);
    const double passesBefore = forceEvaluationsOf(simulation);
    while (simulation.time < time) {
        if (forceEvaluationsOf(simulation) - passesBefore > mostEvaluations) return false;
        StepRestriction& restriction = simulation.restriction;
        const double stop = nextStop(simulation, time);
        const double remaining = stop - simulation.time;
        const double allowed = std::min(longest, restriction.seconds);
        const double count = stepCount(remaining, allowed);
        const double h = remaining / count;
        history.add(simulation);
        takeStep(simulation, h);
        if (count == 1.0 && stop == time) checkIntervalEnd(simulation);
        if (const auto rejection = rejectionReason(simulation, history.latest())) {
            if (h < kShortestStep) reportInstability(simulation, h);
            // Two rejections in a row are evidence against the step that led here.
            history.goBack(simulation, ++rejectedInRow % 2 == 0);
            ++simulation.steps.rejected;
            restriction = {0.5 * h, *rejection, 0};
            if (!isVerlet(simulation.stepper)) establishEnergy(simulation);
            continue;
        }
        rejectedInRow = 0;
        record(simulation.steps, h, restriction.seconds < longest ? restriction.reason : reason, simulation.stepper);
        simulation.time = count == 1.0 ? stop : simulation.time + h;
        emitDue(simulation);
        if (++restriction.passed % kAcceptedBeforeLonger == 0) restriction.seconds *= 2.0;
    }
    return true;
}

}  // namespace engine
