// Estimates the longest stable time step at a state, from a few passes over the pairs and some products with the
// matrices of their damping and stiffness. `globular check` prints it beside the step that a scene asks for.
#pragma once

#include <cstddef>
#include <limits>
#include <optional>

#include "engine/forces/force_field.h"
#include "engine/state/simulation.h"

namespace engine {

struct StepBound {
    double seconds = std::numeric_limits<double>::infinity();
    std::size_t particle = 0;  ///< index of the particle that limits the step
    bool byDamping = false;    ///< whether damping, not stiffness, limits the step
};

/// The longest step (s) that is stable with the pair forces; obstacles are not considered. Empty where no particle acts
/// on another.
///
/// Derivation: the 3x3 sums K_p and C_p of stiffness and damping over one particle's pairs estimate the spectra of K/M
/// and C/M by w^2 = 2 max eig(K_p)/m and g = 2 max eig(C_p)/m. A step h multiplies such a mode by -1 where
///     symplectic Euler:   h^2 w^2 + 2 h g = 4,  that is h = 4 / (g + sqrt(g^2 + 4 w^2))
///     leapfrog:           the same
///     velocity Verlet:    h^2 w^2 + 4 h g = 4,  that is h = 2 / (g + sqrt(g^2 + w^2)), since damping is computed
///                         from the predicted velocity
///     implicit damping:   h^2 w^2 = 4
/// These sums give a safe bound. Power iteration from this bound then finds the mode that really limits the step. The
/// bound is exact for two particles. It knows nothing of contacts that are about to form.
std::optional<StepBound> stepBound(const ForceField& field, const Particles& particles, StepperKind stepper);

}  // namespace engine
