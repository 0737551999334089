// Drift and contacts: what the steppers other than the paper's do to each particle besides the pairs.
#pragma once

#include "engine/parallel.h"
#include "engine/simulation.h"

namespace engine {

/// Makes room for what a step finds out about each particle's way; before any of what follows.
void prepareDrift(Simulation& simulation);

/// Decides whether obstacles are to meet a particle along its way in a step of h seconds; at the step's start, before
/// it moves.
void chooseSwept(Simulation& simulation, std::size_t p, double h);

/// Whether a particle certainly touches no obstacle.
bool isClear(const Simulation& simulation, std::size_t p);

/// Moves a particle for h seconds; the velocity of a swept one changes where it meets an obstacle.
void drift(Simulation& simulation, std::size_t p, double h);

/// The obstacles' force (N) on a particle of that velocity (m/s); zero where it is swept.
Vec3 slowContactForce(const Simulation& simulation, std::size_t p, const Vec3& velocity);

/// Adds the obstacles' damping and stiffness on particles that are not swept to the matrix of a step of h seconds.
/// Both, whatever the matrix holds of the pairs: a heap's weight makes contacts stiffer than anything else.
void addContacts(const Simulation& simulation, double h, PairMatrix& matrix);

/// Calls body(p) for every particle, shared out over the threads: one loop for all that a step does to it.
template <class Body>
void forEachParticle(const Simulation& simulation, const Body& body) {
    constexpr std::size_t kContactGrain = 512;  // chosen: most contacts take a tenth of a microsecond, some a hundred
    const bool hasContacts = !simulation.setup.scenery.colliders.empty();
    inParallel(simulation.particles.count(), hasContacts ? kContactGrain : kParticleGrain, body);
}

}  // namespace engine
