// The longest step at which a state is stable, estimated in one pass over the pairs. `globular check` prints it beside
// the step that a scene asks for.
#pragma once

#include <cstddef>
#include <limits>
#include <optional>

#include "engine/force_law.h"
#include "engine/particles.h"

namespace engine {

struct StepBound {
    double seconds = std::numeric_limits<double>::infinity();
    std::size_t particle = 0;  ///< the one that limits it
    bool byDamping = false;    ///< damping, not stiffness, limits it
};

/// Bound for symplectic Euler and velocity Verlet; nothing where no particle touches another or an obstacle's pair law.
/// Source: with K_p and C_p a particle's own 3x3 sums of stiffness and damping over its pairs, w^2 = 2 max eig(K_p)/m
/// and
///         g = 2 max eig(C_p)/m bound the spectra of K/M and C/M, and dt = 4 / (g + sqrt(g^2 + 4 w^2)).
/// Error:  0.9 to 1.8 times the measured limit on settled states; blind to contacts that are about to form.
std::optional<StepBound> stepBound(const ForceLaw& law, const Particles& particles);

}  // namespace engine
