// The longest step at which a state is stable, estimated from a few passes over the pairs and some products with the
// matrix that they assemble. `globular check` prints it beside the step that a scene asks for.
#pragma once

#include <cstddef>
#include <limits>
#include <optional>

#include "engine/forces/force_law.h"
#include "engine/state/simulation.h"

namespace engine {

struct StepBound {
    double seconds = std::numeric_limits<double>::infinity();
    std::size_t particle = 0;  ///< the one that limits it
    bool byDamping = false;    ///< damping, not stiffness, limits it
};

/// Bound of the pair forces; obstacles are not counted. Nothing where no particle acts on another.
/// Source: a particle's own 3x3 sums K_p and C_p of stiffness and damping over its pairs estimate the spectra of K/M
/// and
///         C/M by w^2 = 2 max eig(K_p)/m and g = 2 max eig(C_p)/m. A step h multiplies such a mode by -1 at
///           symplectic Euler:  h^2 w^2 + 2 h g = 4,  h = 4 / (g + sqrt(g^2 + 4 w^2))
///           leapfrog:          the same,
///           velocity Verlet:   h^2 w^2 + 4 h g = 4,  h = 2 / (g + sqrt(g^2 + w^2)),
///         the last because its damping sees the predicted velocity;
///           implicit-damping:  h^2 w^2 = 4.
///         The own sums are a safe bound; power iteration from there finds the mode that really limits the step.
/// Holds:  exact for two particles; blind to contacts that are about to form.
std::optional<StepBound> stepBound(const ForceLaw& law, const Particles& particles, StepperKind stepper);

}  // namespace engine
