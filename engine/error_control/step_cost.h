// What steps cost, counted instead of timed: the same on every machine, so that choices may depend on it.
#pragma once

#include "engine/state/simulation.h"

namespace engine {

/// What an implicit step pays for its matrix and for a product with it, in passes over all pairs.
struct ImplicitCosts {
    double matrix = 0.0;
    double product = 0.0;
};

/// As shares of a pass with energies: friction makes the pass dearer, and a product no dearer.
ImplicitCosts implicitCosts(const Setup& setup);

/// What the simulation's steps have cost, in passes over all pairs.
double forceEvaluationsOf(const Simulation& simulation);

}  // namespace engine
