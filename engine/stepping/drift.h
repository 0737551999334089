// Drift and contacts: what the steppers other than the paper's do to each particle besides the pairs.
#pragma once

#include <cmath>

#include "engine/stepping/step_cache.h"

namespace engine {

/// Makes room for what a step finds out about each particle's way, and has noted moves forgotten; before any of what
/// follows.
void prepareDrift(Simulation& simulation);

/// Decides whether obstacles are to meet a particle along its way in a step of h seconds; at the step's start, before
/// it moves. Returns their force (N) on it where they are not.
Vec3 chooseSwept(Simulation& simulation, std::size_t p, double h);

/// Whether a particle certainly touches no obstacle.
bool isClear(const Simulation& simulation, std::size_t p);

/// Moves a swept particle for h seconds; its velocity changes where it meets an obstacle.
void driftSwept(Simulation& simulation, std::size_t p, double h);

/// Moves a particle for h seconds.
inline void drift(Simulation& simulation, std::size_t p, double h) {
    const bool hasContacts = !simulation.setup.obstacles.shapes.empty();
    if (hasContacts && simulation.cache->swept[p]) return driftSwept(simulation, p, h);
    const Vec3 way = h * simulation.particles.velocity[p];
    simulation.particles.position[p] += way;
    if (hasContacts) simulation.cache->clearance[p] -= std::sqrt(squaredLength(way));
}

/// The obstacles' force (N) on a particle of that velocity (m/s); zero where it is swept.
Vec3 slowContactForce(const Simulation& simulation, std::size_t p, const Vec3& velocity);

/// The same and the energy (J), which a swept one has too.
ContactAnswer slowContact(const Simulation& simulation, std::size_t p, const Vec3& velocity);

/// Adds the obstacles' damping and stiffness on particles that are not swept to the matrix of a step of h seconds.
/// Both, whatever the matrix holds of the pairs: a heap's weight makes contacts stiffer than anything else.
void addContacts(const Simulation& simulation, double h, PairMatrix& matrix);

}  // namespace engine
