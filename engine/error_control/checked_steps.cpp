// Births, a step, a verdict.
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

/// Chosen: good steps in a row before a longer one is tried again.
constexpr std::uint32_t kAcceptedBeforeLonger = 8;

/// Chosen: how many steps a run can go back. A step may leave a state that no further step from it can pass.
constexpr std::size_t kHistory = 4;

/// The energy of the state as it stands; the forces come with it.
void establishEnergy(Simulation& simulation) {
    requireValid(simulation, 0.0);
    Particles& particles = simulation.particles;
    const double pairEnergy =
        simulation.cache->evaluator.evaluateFree(particles, particles.velocity, simulation.cache->forces);
    ++simulation.steps.forceEvaluations;
    simulation.cache->forcesCurrent = true;
    recordEnergy(simulation, pairEnergy);
}

/// The implicit steppers know the energy in the middle of a step only. What ends an interval can be seen and is never
/// taken back, so its last step is judged by its end too.
void checkIntervalEnd(Simulation& simulation) {
    if (isVerlet(simulation.stepper) || std::isnan(*simulation.cache->energy)) return;
    if (!isValid(simulation.particles)) return markInvalid(simulation);
    establishEnergy(simulation);
}

/// Where the steps have to end next: at the time (s) that was asked for or at a birth on the way, or a newborn would be
/// felt by the others from the next step's start on only.
double nextStop(const Simulation& simulation, double time) {
    double stop = std::numeric_limits<double>::infinity();
    for (std::size_t e = 0; e < simulation.setup.emitters.size(); ++e)
        stop = std::min(stop, nextEmission(simulation.setup.emitters[e], simulation.emitters[e]));
    return stop < time - kSameMoment ? stop : time;
}

/// The states of the last few steps, the latest at the end.
class History {
 public:
    void add(const Simulation& simulation) {
        if (states_.size() == kHistory) std::rotate(states_.begin(), states_.begin() + 1, states_.end());
        if (states_.size() < kHistory) states_.emplace_back();
        save(simulation, states_.back());
    }

    const SavedState& latest() const { return states_.back(); }

    /// Back to the latest state, or, where that has just been tried, to the one before.
    void goBack(Simulation& simulation, bool further) {
        if (further && states_.size() > 1) states_.pop_back();
        restore(simulation, states_.back());
        states_.pop_back();
    }

 private:
    std::vector<SavedState> states_;
};

}  // namespace

bool advanceChecked(Simulation& simulation, double time, double longest, StepLimit why, double mostEvaluations) {
    History history;
    int refused = 0;
    emitDue(simulation);
    if (!simulation.cache->energy) establishEnergy(simulation);
    const double passesBefore = forceEvaluationsOf(simulation);
    while (simulation.time < time) {
        if (forceEvaluationsOf(simulation) - passesBefore > mostEvaluations) return false;
        StepRestriction& restriction = simulation.restriction;
        const double stop = nextStop(simulation, time);
        const double remaining = stop - simulation.time;
        const double allowed = std::min(longest, restriction.seconds);
        // The smallest whole number of steps; the slack keeps 0.02 s at steps of 0.01 s from becoming three.
        const double count = std::max(1.0, std::ceil(remaining / allowed * (1.0 - 1e-9)));
        const double h = remaining / count;
        history.add(simulation);
        takeStep(simulation, h);
        if (count == 1.0 && stop == time) checkIntervalEnd(simulation);
        if (const auto reason = rejectionReason(simulation, history.latest())) {
            if (h < kShortestStep) reportInstability(simulation, h);
            // Two refusals in a row speak against the step that led here.
            history.goBack(simulation, ++refused % 2 == 0);
            ++simulation.steps.rejected;
            restriction = {0.5 * h, *reason, 0};
            if (!isVerlet(simulation.stepper)) establishEnergy(simulation);
            continue;
        }
        refused = 0;
        record(simulation.steps, h, restriction.seconds < longest ? restriction.reason : why, simulation.stepper);
        simulation.time = count == 1.0 ? stop : simulation.time + h;
        emitDue(simulation);
        if (++restriction.passed % kAcceptedBeforeLonger == 0) restriction.seconds *= 2.0;
    }
    return true;
}

}  // namespace engine
