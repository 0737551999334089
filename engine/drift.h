// Drift, drag and contacts: what the steppers other than the paper's do besides the pairs.
#pragma once

#include "engine/simulation.h"

namespace engine {

/// Decides which particles are swept past the obstacles in a step of h seconds; at its start, before anything moves.
void chooseSwept(Simulation& simulation, double h);

/// Whether a particle certainly touches no obstacle.
bool isClear(const Simulation& simulation, std::size_t p);

/// Moves all particles for h seconds; the velocities of swept ones change where they meet an obstacle.
void drift(Simulation& simulation, double h);

/// What drag leaves of all velocities after h seconds; nothing happens without drag.
void applyDrag(Simulation& simulation, double h);

/// Adds the obstacles' forces on particles that are not swept, with the given velocities (m/s) in the damping, N.
void addContacts(const Simulation& simulation, const std::vector<Vec3>& velocities, std::vector<Vec3>& forces);

/// Adds the obstacles' damping and stiffness on particles that are not swept to the matrix of a step of h seconds.
/// Both, whatever the matrix holds of the pairs: a heap's weight makes contacts stiffer than anything else.
void addContacts(const Simulation& simulation, double h, PairMatrix& matrix);

}  // namespace engine
