// Drift and contacts: what the steppers other than the paper's do to each particle besides the pair forces. A step
// calls prepareDrift once, then chooseSweptContact for each particle, and only then moves particles.
#pragma once

#include <cmath>

#include "engine/stepping/step_cache.h"

namespace engine {

/// Sizes the step cache's arrays by particle, notes the positions at the step's start, and invalidates the displacement
/// bound, because each particle takes a path of its own from here.
void prepareDrift(Simulation& simulation);

/// Decides whether the obstacles act on a particle along its path in a step of h seconds (a swept contact) or as a
/// force. Called at the step's start, before the particle moves. Returns the force, N; zero where the contact is swept.
Vec3 chooseSweptContact(Simulation& simulation, std::size_t p, double h);

/// Whether a particle certainly touches no obstacle.
bool isClearOfObstacles(const Simulation& simulation, std::size_t p);

/// Moves a particle with a swept contact for h seconds; its velocity changes where it meets an obstacle.
void driftSwept(Simulation& simulation, std::size_t p, double h);

/// Moves a particle for h seconds.
inline void drift(Simulation& simulation, std::size_t p, double h) {
    const bool hasObstacles = !simulation.setup.obstacles.shapes.empty();
    if (hasObstacles && simulation.cache->swept[p]) return driftSwept(simulation, p, h);
    const Vec3 displacement = h * simulation.particles.velocity[p];
    simulation.particles.position[p] += displacement;
    if (hasObstacles) simulation.cache->clearance[p] -= std::sqrt(squaredLength(displacement));
}

/// Force of the obstacles on a particle that has this velocity (m/s), and its energy at them. Where the contact is
/// swept, the force is zero, but not the energy.
ContactSums resolvedContacts(const Simulation& simulation, std::size_t p, const Vec3& velocity);

/// Adds the obstacles' damping and stiffness on particles whose contacts are not swept to the matrix of a step of h
/// seconds. Both are added whatever the matrix holds of the pairs: the weight of a heap makes contacts stiffer than
/// anything else.
void addContacts(const Simulation& simulation, double h, PairMatrix& matrix);

}  // namespace engine
