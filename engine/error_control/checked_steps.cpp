// The loop of audited steps: emit particles, take a step, and accept or reject the step.
#include "engine/error_control/checked_steps.h"

#include <algorithm>
#include <cmath>

#include "engine/error_control/step_control.h"
#include "engine/error_control/step_cost.h"
#include "engine/heat/agitation.h"
#include "engine/heat/heat_moment.h"
#include "engine/state/state_checks.h"
#include "engine/stepping/obstacle_loads.h"
#include "engine/stepping/population.h"
#include "engine/stepping/step_audit.h"
#include "engine/stepping/step_cache.h"
#include "engine/stepping/take_step.h"

namespace engine {
namespace {

/// Number of accepted steps after which a restricted step is doubled. Chosen.
constexpr std::uint32_t kAcceptedBeforeLonger = 8;

/// Number of steps that can be taken back. More than one is needed, because an accepted step may lead to a state from
/// which no step is accepted. Chosen.
constexpr std::size_t kHistory = 4;

/// Computes and records the energy and the forces of the present state, which is that at a time (s).
void establishEnergy(Simulation& simulation, double time) {
    requireValid(simulation, 0.0);
    Particles& particles = simulation.particles;
    const double pairEnergy =
        simulation.cache->evaluator.evaluateFree(particles, particles.velocity, simulation.cache->forces);
    ++simulation.steps.forceEvaluations;
    simulation.cache->forcesCurrent = true;
    recordEnergy(simulation, pairEnergy, time);
}

/// Computes the energy after the last step of an interval where the stepper does not. The implicit steppers know the
/// energy in the middle of a step only, but the state at the end of an interval is used outside and never taken back,
/// so the last step is also audited by the energy at its end.
void checkIntervalEnd(Simulation& simulation, double time) {
    if (isVerlet(simulation.stepper) || std::isnan(*simulation.cache->energy)) return;
    if (!isValid(simulation)) return markInvalid(simulation);
    establishEnergy(simulation, time);
}

/// The latest time at which the next step must end, s: the requested time, or an emission, an exchange of heat or an
/// agitation before it. A step across an emission would leave the new particle without forces until the start of the
/// next step.
double nextStop(const Simulation& simulation, double time) {
    const double stop = std::min({nextEmission(simulation), nextHeatMoment(simulation), nextAgitation(simulation)});
    return stop < time - kSameMoment ? stop : time;
}

/// The saved states before the last few steps, with the latest at the end.
class History {
 public:
    void add(const Simulation& simulation) {
        if (states_.size() == kHistory) std::rotate(states_.begin(), states_.begin() + 1, states_.end());
        if (states_.size() < kHistory) states_.emplace_back();
        save(simulation, states_.back());
    }

    const SavedState& latest() const { return states_.back(); }

    /// Forgets all states, after a change that cannot be taken back.
    void clear() { states_.clear(); }

    /// Restores the latest saved state or, if `further`, the state before that.
    void goBack(Simulation& simulation, bool further) {
        if (further && states_.size() > 1) states_.pop_back();
        restore(simulation, states_.back());
        states_.pop_back();
    }

 private:
    std::vector<SavedState> states_;
};

}  // namespace

bool advanceChecked(Simulation& simulation, double time, double longest, StepLimit reason, double mostEvaluations,
                    ErrorControl* errors) {
    History history;
    int rejectedInRow = 0;
    emitDue(simulation);
    simulation.cache->work = simulation.cache->workAtEnergy = 0.0;  // as in a run that is resumed here
    if (!simulation.cache->energy) establishEnergy(simulation, simulation.time);
    simulation.cache->energyAtHeat = *simulation.cache->energy;
    const double passesBefore = forceEvaluationsOf(simulation);
    while (simulation.time < time) {
        if (forceEvaluationsOf(simulation) - passesBefore > mostEvaluations) return false;
        if (simulation.beforeStep) simulation.beforeStep(simulation);
        StepRestriction& restriction = simulation.restriction;
        const double stop = nextStop(simulation, time);
        const double remaining = stop - simulation.time;
        const double wanted = errors == nullptr ? longest : std::min(longest, errors->steps.step);
        const double allowed = std::min(wanted, restriction.seconds);
        const double count = stepCount(remaining, allowed);
        const double h = remaining / count;
        history.add(simulation);
        takeStep(simulation, h);
        const bool isHeatDue = count == 1.0 && isHeatDueAt(simulation, stop);
        const bool isAgitationDue = count == 1.0 && isAgitationDueAt(simulation, stop);
        if (count == 1.0 && (stop == time || isHeatDue || isAgitationDue)) checkIntervalEnd(simulation, stop);
        std::optional<StepLimit> rejection = rejectionReason(simulation, history.latest());
        std::optional<double> estimate;
        if (errors != nullptr && !rejection) {
            estimate = estimateStep(simulation, history.latest(), h);
            if (estimate && isRefused(errors->steps, *estimate, errors->wanted)) rejection = StepLimit::error;
        }
        if (rejection) {
            if (h < kShortestStep) reportInstability(simulation, h);
            // Two rejections in a row suggest that the previous step, although accepted, was bad.
            history.goBack(simulation, ++rejectedInRow % 2 == 0);
            ++simulation.steps.rejected;
            restriction = {0.5 * h, *rejection, 0};
            if (!isVerlet(simulation.stepper)) establishEnergy(simulation, simulation.time);
            continue;
        }
        rejectedInRow = 0;
        acceptLoads(simulation);
        const StepLimit chosen = errors != nullptr && errors->steps.step >= longest ? StepLimit::frame : reason;
        record(simulation.steps, h, restriction.seconds < wanted ? restriction.reason : chosen, simulation.stepper);
        if (estimate) {
            errors->estimate += h * *estimate;
            control(errors->steps, simulation.stepper, h, *estimate, errors->wanted);
        }
        simulation.time = count == 1.0 ? stop : simulation.time + h;
        if (isHeatDue) {
            if (exchangeHeatDue(simulation)) establishEnergy(simulation, simulation.time);
            simulation.cache->energyAtHeat = *simulation.cache->energy - simulation.cache->workAtEnergy;
        }
        if (isAgitationDue) agitateDue(simulation);
        if (isHeatDue || isAgitationDue) history.clear();
        emitDue(simulation);
        if (++restriction.passed % kAcceptedBeforeLonger == 0) restriction.seconds *= 2.0;
    }
    return true;
}

}  // namespace engine
