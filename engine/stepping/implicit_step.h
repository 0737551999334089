// The implicit steppers, which treat damping, or damping and stiffness, by the implicit midpoint rule. Called by
// takeStep().
#pragma once

#include "engine/forces/pair_matrix.h"
#include "engine/state/simulation.h"

namespace engine {

/// One step of h seconds: half a drift, a kick, half a drift, with swept contacts. The kick is the implicit midpoint
/// rule, linearized at the positions x in the middle of the step. With w the mean of the old and the new velocity and d
/// = w - v:
///     M (v' - v)/h = F(x) - C w - (h/2) K d      =>      (M + h/2 C + h^2/4 K) d = h/2 (F - C v),  v' = v + 2 d
/// where F - C v is the pair force and gravity at x and v, C the damping along every pair, and K the stiffness max(k,
/// 0) along it. The weights are h/2 and h^2/4, or 0 to leave C or K out of the matrix. Without K the step is stable at
/// any damping for h^2 omega^2 < 4, where omega is the largest frequency; with K it is stable at any stiffness along
/// the pairs.
void implicitStep(Simulation& simulation, double h, const MatrixWeights& weights);

}  // namespace engine
