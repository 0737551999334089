// Whether positions and velocities are numbers that the engine can go on from. Checked after particles were emitted and
// after every move, before anything is computed from them.
#pragma once

#include <cmath>

#include "engine/state/simulation.h"

namespace engine {

/// A position further out than this counts as lost, m: beyond it the cell grid and float pictures lose their meaning.
inline constexpr double kWorldLimit = 1e8;

/// The largest speed whose square is still finite in double with room to spare, m/s.
inline constexpr double kFastest = 1e150;

/// Whether every component is below the limit in magnitude; written so that a NaN fails.
inline bool areBelow(const Vec3& vector, double limit) {
    return std::abs(vector.x()) < limit && std::abs(vector.y()) < limit && std::abs(vector.z()) < limit;
}

/// Whether a particle is within the world's limit and the square of its speed is finite.
inline bool isValid(const Vec3& position, const Vec3& velocity) {
    return areBelow(position, kWorldLimit) && areBelow(velocity, kFastest);
}

/// Whether all particles are valid.
bool isValid(const Particles& particles);

/// Throws an InstabilityError that names the first invalid particle, or else the fastest one.
/// @param h  length of the step that could not be taken, s
[[noreturn]] void reportInstability(const Simulation& simulation, double h);

/// Does nothing if all particles are valid, and otherwise throws an InstabilityError that names the first invalid one.
/// @param h  length of the step that led here, s
void requireValid(const Simulation& simulation, double h);

}  // namespace engine
