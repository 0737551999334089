// Counts of the run's statistics, times weights.
#include "engine/error_control/step_cost.h"

#include <algorithm>

namespace engine {
namespace {

/// Measured: the seconds of steps of liquid, solid, oil, splash and honey against their counts in `globular study
/// accuracy`.
constexpr ImplicitCosts kWithoutFriction{.matrix = 1.0, .product = 0.15};

/// Measured in the same way on lava and mud.
constexpr ImplicitCosts kWithFriction{.matrix = 0.8, .product = 0.13};

}  // namespace

ImplicitCosts implicitCosts(const Setup& setup) {
    const bool hasFriction =
        std::ranges::any_of(setup.materials, [](const Material& material) { return material.friction > 0.0; });
    return hasFriction ? kWithFriction : kWithoutFriction;
}

double forceEvaluationsOf(const Simulation& simulation) {
    const StepStatistics& steps = simulation.steps;
    const ImplicitCosts costs = implicitCosts(simulation.setup);
    const auto takenBy = [&](StepperKind stepper) {
        return static_cast<double>(steps.takenBy[static_cast<std::size_t>(stepper)]);
    };
    const double matrices = takenBy(StepperKind::implicitDamping) + takenBy(StepperKind::linearlyImplicit);
    return static_cast<double>(steps.forceEvaluations) + costs.matrix * matrices +
           costs.product * static_cast<double>(steps.products);
}

}  // namespace engine
