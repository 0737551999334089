// How steppers other than the paper's move particles and treat their contacts with obstacles. A step calls
// prepareDrift() once, then chooseSweptContact() for each particle, and moves particles only after that.
#pragma once

#include <cmath>

#include "engine/stepping/step_cache.h"

namespace engine {

/// Prepares the step cache for a step of h seconds in a scene with obstacles: resizes the arrays that have an entry for
/// each particle, and stores the positions at the start of the step.
void prepareDrift(Simulation& simulation, double h);

/// Decides whether the obstacles act on a particle along its path in a step of h seconds (a swept contact) or as a
/// force at the start of the step. Called before the particle moves. Returns the force, N; zero where the contact is
/// swept.
Vec3 chooseSweptContact(Simulation& simulation, std::size_t p, double h);

/// Whether a particle is known to touch no obstacle, without computing its distance from any.
bool isClearOfObstacles(const Simulation& simulation, std::size_t p);

/// Whether no obstacle was in a particle's way in a step: whether all of them were further from where it started (m)
/// than it has moved. Depends on the step only, and not on what is known of the particle's clearance.
bool hadFreePath(const Simulation& simulation, std::size_t p, const Vec3& start);

/// Moves a particle with a swept contact for h seconds from a time (s) on; its velocity changes where it meets an
/// obstacle.
void driftSwept(Simulation& simulation, std::size_t p, double from, double h);

/// Moves a particle along its velocity for h seconds from a time (s) on, but not through the surface of an obstacle: it
/// slides along.
void driftToBarriers(Simulation& simulation, std::size_t p, double from, double h);

/// Moves a particle for h seconds from a time (s) on.
inline void drift(Simulation& simulation, std::size_t p, double from, double h) {
    const bool hasObstacles = !simulation.setup.obstacles.shapes.empty();
    if (hasObstacles && simulation.cache->swept[p]) return driftSwept(simulation, p, from, h);
    const Vec3 displacement = h * simulation.particles.velocity[p];
    if (!hasObstacles) {
        simulation.particles.position[p] += displacement;
        return;
    }
    double& clearance = simulation.cache->clearance[p];
    const double length = std::sqrt(squaredLength(displacement)) + h * simulation.cache->surfaceSpeed;
    // A surface holds the center, which is a radius further from it than the particle's surface.
    const bool mayArrive = length > clearance + simulation.particles.radius[p];
    clearance -= length;
    if (mayArrive && simulation.setup.obstacles.wall == WallLaw::scaled) return driftToBarriers(simulation, p, from, h);
    simulation.particles.position[p] += displacement;
}

/// Adds to the statistics how often surfaces held particles' centers in a step. Called at its end.
void recordHeld(Simulation& simulation);

/// Force of the obstacles at a time (s) on a particle that has this velocity (m/s), and its energy at them. Where the
/// contact is swept, the force is zero, but not the energy.
/// @param seconds  for which the force acts, s; its loads are recorded unless this is zero
ContactSums resolvedContacts(Simulation& simulation, std::size_t p, const Vec3& velocity, double time, double seconds);

/// Records the loads of half the kick of an implicit step of h seconds.
/// @param velocity  of the particle before the kick, m/s
/// @param change    of the velocity by half the kick, m/s
/// @param time      in the middle of the step, s
void recordHalfKick(Simulation& simulation, std::size_t p, const Vec3& velocity, const Vec3& change, double time,
                    double h);

/// Adds damping and stiffness of contacts with obstacles to the matrix of an implicit step of h seconds, for particles
/// whose contacts are not swept. Stiffness is added even by the stepper that treats only damping implicitly, because
/// the contacts under the weight of a heap are stiffer than any pair of particles.
/// @param time  in the middle of the step, s
void addContacts(const Simulation& simulation, double time, double h, PairMatrix& matrix);

}  // namespace engine
