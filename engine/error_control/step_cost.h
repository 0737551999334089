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

/// The costs of an implicit step for the materials of a setup. They are lower for materials with friction, because
/// friction makes the unit, a force evaluation, more expensive, but neither the matrix nor a product with it.
ImplicitCosts implicitCosts(const Setup& setup);

/// Cost of the simulation's steps so far, in force evaluations.
double forceEvaluationsOf(const Simulation& simulation);

}  // namespace engine
