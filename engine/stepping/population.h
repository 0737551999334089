// How particles enter and leave a run: emission once a step, removal between intervals, so that no step and no
// verdict on one sees a particle disappear.
#pragma once

#include <cstddef>
#include <cstdint>

#include "engine/neighbors/linked_cells.h"
#include "engine/state/simulation.h"

namespace engine {

/// Emits all particles that are due at the simulation's time, emitter by emitter; each sees all that were emitted
/// before it.
/// @throws InstabilityError when one is outside what the engine can represent.
void emitDue(Simulation& simulation);

/// Removes the particles that are outside the bounds of the world, if it has any; the others keep their order and ids.
/// Takes time linear in the number of particles.
void removeOutOfBounds(Simulation& simulation);

/// What an emission needs to know of the rest of the simulation.
struct EmissionContext {
    double time = 0.0;            ///< now, s
    Vec3 gravity = Vec3::Zero();  ///< m/s^2, acts on a particle from its due time until now
    std::uint64_t seed = 1;
    std::uint64_t emitterIndex = 0;  ///< part of the key of its random numbers
};

/// The distance within which an emission looks for particles in its way, m, where no radius is larger than the one
/// given (m).
double clearanceDistance(const Emitter& emitter, double largestRadius);

/// Appends the particles that are due at or before the context's time and have room, and adds them to the cells. The
/// cells hold all particles and are at least as wide as the clearance distance. A particle that was due earlier starts
/// where free flight would have taken it by now. Returns how many were emitted.
std::size_t emit(const Emitter& emitter, EmitterState& state, const EmissionContext& context, const Material& material,
                 Particles& particles, LinkedCells& cells);

}  // namespace engine
