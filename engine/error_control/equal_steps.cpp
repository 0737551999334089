// Emits particles, takes a step, exchanges heat, agitates particles, and checks that nothing has become invalid.
#include "engine/error_control/equal_steps.h"

#include "engine/heat/agitation.h"
#include "engine/heat/heat_moment.h"
#include "engine/state/state_checks.h"
#include "engine/stepping/obstacle_loads.h"
#include "engine/stepping/population.h"
#include "engine/stepping/step_cache.h"
#include "engine/stepping/symplectic_euler.h"
#include "engine/stepping/take_step.h"

namespace engine {

void advanceInEqualSteps(Simulation& simulation, double time) {
    const double from = simulation.time;
    const double count = stepCount(time - from, simulation.setup.step);
    const double h = (time - from) / count;
    if (simulation.steps.count == 0) requireValid(simulation, h);  // the states after later steps are validated below
    for (double step = 0.0; step < count; step += 1.0) {
        simulation.time = from + step * h;
        if (simulation.beforeStep) simulation.beforeStep(simulation);
        emitDue(simulation);
        kickBefore(simulation, h);
        const bool areAllValid = symplecticEulerStep(simulation, h);
        if (areAllValid) kickAfter(simulation, h);
        record(simulation.steps, h, StepLimit::fixed, simulation.stepper);
        addUpLoads(simulation);
        acceptLoads(simulation);
        if (!areAllValid) requireValid(simulation, h);
        const double end = step + 1.0 < count ? from + (step + 1.0) * h : time;
        const bool isHeatDue = isHeatDueAt(simulation, end);
        const bool isAgitationDue = isAgitationDueAt(simulation, end);
        if (isHeatDue || isAgitationDue) simulation.time = end;
        if (isHeatDue) exchangeHeatDue(simulation);
        if (isAgitationDue) agitateDue(simulation);
    }
    simulation.time = time;
    emitDue(simulation);
}

}  // namespace engine
