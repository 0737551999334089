// Chooses how much of a frame an error sample runs again.
#include "engine/error_control/error_samples.h"

#include <algorithm>
#include <cmath>

#include "engine/error_control/error_estimate.h"
#include "engine/error_control/step_cost.h"
#include "engine/stepping/take_step.h"

namespace engine {
namespace {

/// A trial takes its steps at the step of the run and again at half of it, three steps for one.
constexpr double kRunsOfTrial = 3.0;

/// Force evaluations with which the two runs of a trial may establish the energy at their ends, where steps are
/// audited.
double evaluationsOfEnds(StepperKind stepper) {
    return stepper == StepperKind::symplecticEuler ? 0.0 : 2.0;
}

}  // namespace

void addSample(ErrorSamples& samples, const Simulation& simulation, double frameSeconds, double evaluationsOfFrame) {
    if (simulation.setup.stepper == StepperKind::automatic) return;
    const double stepsOfFrame = stepCount(frameSeconds, simulation.setup.step);
    const double allowed = kErrorSampleShare * forceEvaluationsOf(simulation) - samples.evaluationCost -
                           evaluationsOfEnds(simulation.stepper);
    const double costOfStep = std::max(1.0, evaluationsOfFrame / stepsOfFrame);
    const double steps = std::min(stepsOfFrame, std::floor(allowed / (kRunsOfTrial * costOfStep)));
    if (steps < 1.0) return;
    TrialRun trial{simulation.time + frameSeconds * (steps / stepsOfFrame), simulation.stepper, simulation.setup.step};
    trial.mostEvaluations = allowed / kRunsOfTrial;
    trial.mostOfFiner = allowed - trial.mostEvaluations;
    try {
        const Trial estimate = measure(simulation, trial);
        samples.evaluationCost += estimate.spent;
        if (!estimate.finished) return;
        ++samples.count;
        samples.sum += estimate.error;
        samples.largest = std::max(samples.largest, estimate.error);
    } catch (const InstabilityError&) {
        // The run itself will report the instability when it gets there.
    }
}

}  // namespace engine
