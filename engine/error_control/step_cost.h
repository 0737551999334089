// The cost of time steps. It is counted instead of timed, so that it is the same on every machine and choices may
// depend on it. The unit is one force evaluation, which is a pass over all pairs of particles.
#pragma once

#include "engine/state/simulation.h"

namespace engine {

/// Cost of assembling the matrix of an implicit step, and of one product with it, in force evaluations.
struct ImplicitCosts {
    double matrix = 0.0;
    double product = 0.0;
};

/// The costs of an implicit step for the materials of a setup. Friction makes a force evaluation more expensive but not
/// a product, so both costs are lower with friction.
ImplicitCosts implicitCosts(const Setup& setup);

/// Cost of the simulation's steps so far, in force evaluations.
double forceEvaluationsOf(const Simulation& simulation);

}  // namespace engine
