// The loads of obstacles, from what contacts record in a step to the sums of a run. Contacts are on many threads and
// ranks; the sums are exact until they are rounded, so that they have the same bits for any number of both.
#pragma once

#include "engine/state/simulation.h"

namespace engine {

/// The list in which contacts on this thread are recorded; null where no load of any obstacle is.
ContactLoads* loadsOfThread(Simulation& simulation);

/// Adds what was recorded since the last call to the loads of the present step, and its work to that of all steps.
void addUpLoads(Simulation& simulation);

/// Adds the loads of a step that was accepted to those of the run.
void acceptLoads(Simulation& simulation);

}  // namespace engine
