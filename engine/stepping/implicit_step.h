// The implicit steppers; called by takeStep.
#pragma once

#include "engine/forces/pair_matrix.h"
#include "engine/state/simulation.h"

namespace engine {

/// Half a drift, a kick, half a drift, with swept contacts.
/// The kick is the implicit midpoint rule, linearized at the positions x in the middle. With w the mean of the old and
/// the new velocity and d = w - v:
///     M (v' - v)/h = F(x) - C w - (h/2) K d      =>      (M + h/2 C + h^2/4 K) d = h/2 (F - C v),  v' = v + 2 d
/// where F - C v is the whole pair force and gravity at x and v, C the damping along every pair, and K the stiffness
/// max(k, 0) along it. The weights say which of the two the matrix holds (step sizes in them: h/2 and h^2/4).
/// Without K it is stable for h^2 w^2 < 4 at any damping, with K at any stiffness along the pairs.
void implicitStep(Simulation& simulation, double h, const MatrixWeights& weights);

}  // namespace engine
