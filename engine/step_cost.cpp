// Counts times weights.
#include "engine/step_cost.h"

namespace engine {

double passesOf(const StepStatistics& steps) {
    const auto takenBy = [&](StepperKind stepper) {
        return static_cast<double>(steps.takenBy[static_cast<std::size_t>(stepper)]);
    };
    const double matrices = takenBy(StepperKind::implicitDamping) + takenBy(StepperKind::linearlyImplicit);
    return static_cast<double>(steps.forceEvaluations) + kMatrixCost * matrices +
           kProductCost * static_cast<double>(steps.products);
}

}  // namespace engine
