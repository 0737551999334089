// Estimates the memory that a run needs. The largest part is the neighbor list. Used by `globular check`.
#pragma once

#include <cstddef>

#include "engine/state/simulation.h"

namespace engine {

/// Largest number of bytes that a run will hold for its materials, whatever the number of particles.
std::size_t peakBytesOfMaterials(const Simulation& simulation);

/// Largest number of bytes that a run from this state will hold for its particles, provided that the number of
/// particles and their distances stay the same: the memory of a step or, for the automatic stepper, of an error
/// estimate.
std::size_t peakBytes(const Simulation& simulation);

}  // namespace engine
