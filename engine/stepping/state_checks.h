// The check that a state is still one: called after births and after every move of the particles,
// before anything is computed from it.
#pragma once

#include <cmath>

#include "engine/state/simulation.h"

namespace engine {

/// A position further out than this counts as lost, m: beyond it the cell grid and float pictures lose their meaning.
inline constexpr double kWorldLimit = 1e8;

/// A speed whose square is a number still, m/s.
inline constexpr double kFastest = 1e150;

/// Written so that a NaN fails.
inline bool areBelow(const Vec3& vector, double limit) {
    return std::abs(vector.x()) < limit && std::abs(vector.y()) < limit && std::abs(vector.z()) < limit;
}

/// Whether a particle is within the world and the square of its speed is a number.
inline bool isValid(const Vec3& position, const Vec3& velocity) {
    return areBelow(position, kWorldLimit) && areBelow(velocity, kFastest);
}

/// The same of all.
bool isValid(const Particles& particles);

/// Throws InstabilityError, naming the first particle that is not sound, or else the fastest one.
/// Shape:  h is the length of the step that could not be taken, s.
[[noreturn]] void reportInstability(const Simulation& simulation, double h);

/// Throws InstabilityError, naming the first particle whose position has left the world or whose speed is not finite.
/// Shape:  h is the step that led here, s.
void requireValid(const Simulation& simulation, double h);

}  // namespace engine
