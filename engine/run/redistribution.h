// How the particles of a run get from rank to rank. A rank's particles take along everything that later steps depend
// on, so that a run continues with the same bits on any other division of its particles, or in one process.
#pragma once

#include "engine/state/simulation.h"

namespace engine {

/// Moves every particle to the rank that the ranks say is the owner of its position. To be called between intervals.
void redistribute(Simulation& simulation);

/// Brings the particles of all ranks together on rank 0.
/// @param whole  on rank 0, gets all particles, the time and the statistics, but nothing that later steps depend on;
/// not
///               changed on the others
void gather(const Simulation& simulation, Simulation& whole);

/// On rank 0, the checkpoint that a run in one process would have; empty on the others.
std::vector<std::uint8_t> gatherCheckpoint(const Simulation& simulation);

/// Divides a simulation that rank 0 has as a whole, for example from a checkpoint, among the ranks.
/// @param simulation  on the other ranks, one that was started from the same setup in one process
/// @param ranks       name the owners of all positions
void divide(Simulation& simulation, const Ranks& ranks);

}  // namespace engine
