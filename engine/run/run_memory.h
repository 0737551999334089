// An estimate of the memory that a run needs, from its neighbor list, which is the largest part. Used by `globular
// check`.
#pragma once

#include <cstddef>

#include "engine/state/simulation.h"

namespace engine {

/// Bytes that a run in this state holds at most if its particles stay as many and as close to each other: those of a
/// step by the stepper that needs most, or of an error estimate by the automatic one.
std::size_t peakBytes(const Simulation& simulation);

}  // namespace engine
