// The mean radius of particles, by which grids and layers are as wide as they are.
#pragma once

#include <span>

#include "render/picture/view.h"

namespace render {

/// Mean radius of the particles, m; 0 without particles.
inline double meanRadius(std::span<const Sphere> particles) {
    double sum = 0.0;
    for (const Sphere& particle : particles) sum += double(particle.radius);
    return particles.empty() ? 0.0 : sum / static_cast<double>(particles.size());
}

}  // namespace render
