// Checks whether positions and velocities are numbers that the engine can compute with. They are checked whenever
// particles have been emitted or moved, before anything is computed from them.
#pragma once

#include <cmath>

#include "engine/state/simulation.h"

namespace engine {

/// Bound on every coordinate of a position, m. Beyond it cell grids and pictures in single precision are no longer
/// accurate.
inline constexpr double kWorldLimit = 1e8;

/// Bound on every component of a velocity, m/s: the square of a speed stays finite in double, with a wide margin.
inline constexpr double kFastest = 1e150;

/// Radii (m) and masses (kg) of particles that scenes may have. Chosen: from a few atoms to a tenth of the world; the
/// powers of them that forces and pictures are computed with stay far within the ranges of double and float.
inline constexpr double kLeastRadius = 1e-9;
inline constexpr double kLargestRadius = 1e7;
inline constexpr double kLeastMass = 1e-30;
inline constexpr double kLargestMass = 1e30;

/// Whether every component is below the limit in magnitude; written so that a NaN fails.
inline bool areBelow(const Vec3& vector, double limit) {
    return std::abs(vector.x()) < limit && std::abs(vector.y()) < limit && std::abs(vector.z()) < limit;
}

/// Whether the position of a particle is within the world's limit and its velocity within the bound on velocities.
inline bool isValid(const Vec3& position, const Vec3& velocity) {
    return areBelow(position, kWorldLimit) && areBelow(velocity, kFastest);
}

/// Whether the positions and velocities of the particles of all ranks are valid.
bool isValid(const Simulation& simulation);

/// Throws an InstabilityError that names the first particle with an invalid position or velocity or, if there is none,
/// the fastest particle.
/// @param h  length of the rejected time step, s
[[noreturn]] void reportInstability(const Simulation& simulation, double h);

/// Throws an InstabilityError that names the first particle with an invalid position or velocity; does nothing if there
/// is none.
/// @param h  length of the time step that led to this state, s; 0 before the first step
void requireValid(const Simulation& simulation, double h);

}  // namespace engine
