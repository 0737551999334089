// Sets of obstacles with a single one, and particles that meet them.
#pragma once

#include <limits>

#include "engine/obstacles/obstacles.h"

/// A reach that includes all obstacles, m.
inline constexpr double kFar = std::numeric_limits<double>::infinity();

inline engine::Obstacles only(const engine::Obstacle& obstacle) {
    engine::Obstacles obstacles;
    obstacles.shapes = {obstacle};
    return obstacles;
}

/// A particle of this mass (kg).
inline engine::Probe withMass(engine::Probe particle, double mass) {
    particle.mass = mass;
    return particle;
}
