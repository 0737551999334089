// The cost of steps, counted instead of timed: it is the same on every machine, so that choices may depend on it. The unit is
// one force evaluation, a pass over all pairs.
#pragma once

#include "engine/state/simulation.h"

namespace engine {

/// Cost of assembling the matrix of an implicit step, and of one product with it, in force evaluations.
struct ImplicitCosts {
    double matrix = 0.0;
    double product = 0.0;
};

/// Depends on friction, which makes a force evaluation more expensive but not a product.
ImplicitCosts implicitCosts(const Setup& setup);

/// Cost of the simulation's steps so far, in force evaluations.
double forceEvaluationsOf(const Simulation& simulation);

}  // namespace engine
