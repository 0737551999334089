// What steps cost, counted instead of timed: the same on every machine, so that choices may depend on it.
#pragma once

#include "engine/simulation.h"

namespace engine {

/// What an implicit step pays for its matrix and for a product with it, in passes over all pairs. Measured: the seconds
/// of steps of liquid, solid and honey against their counts in `globular study accuracy`.
inline constexpr double kMatrixCost = 0.3;
inline constexpr double kProductCost = 0.27;

/// What steps cost, in passes over all pairs.
double passesOf(const StepStatistics& steps);

}  // namespace engine
