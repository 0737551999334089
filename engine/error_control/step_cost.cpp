// Computes the cost of steps from the counts in a run's statistics, times measured weights.
#include "engine/error_control/step_cost.h"

#include <algorithm>

namespace engine {
namespace {

/// Costs of an implicit step in scenes without friction. Measured: the times of steps in the scenes liquid, solid, oil,
/// splash and honey, compared with their counts, in `globular study accuracy`.
constexpr ImplicitCosts kWithoutFriction{.matrix = 1.0, .product = 0.15};

/// Costs of an implicit step in scenes with friction. Measured in `globular study accuracy` on the scenes lava and mud.
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
    return static_cast<double>(steps.forceEvaluations) + costs.matrix * static_cast<double>(steps.matrices) +
           costs.product * static_cast<double>(steps.products);
}

}  // namespace engine
