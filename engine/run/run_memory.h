// What a run needs in memory, told from its neighbor list, which is the greatest part. Asked by `globular check`.
#pragma once

#include <cstddef>

#include "engine/state/simulation.h"

namespace engine {

/// Bytes that a run which has got here holds at most, if its particles stay as many and as near to each other: a step
/// by the stepper that needs most, or the looks of the automatic one.
/// Costs:  O(1) beside bytesOf(list).
std::size_t mostBytes(const Simulation& simulation);

}  // namespace engine
