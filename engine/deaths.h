// How particles leave a bounded world. Between intervals, so that no step, and no verdict on one, sees it happen.
// Called by advance().
#pragma once

#include "engine/simulation.h"

namespace engine {

/// Removes the particles that are beyond the bounds of the world, if it has any; the others keep their order and ids.
/// Costs: O(n).
void removeLeavers(Simulation& simulation);

}  // namespace engine
