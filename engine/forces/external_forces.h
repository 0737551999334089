// What acts on particles besides each other, the paper's way: their weight, and obstacles as forces.
#pragma once

#include <cstddef>
#include <vector>

#include "engine/forces/force_law.h"

namespace engine {

/// Adds weight and obstacles of particles begin to end - 1 to their forces (N). Shape: velocities in m/s.
/// Holds:  equal to the weight and contactForce(), one after the other, on any instruction set, and however particles
/// are split up into ranges.
void addExternalForces(const ForceLaw& law, const Particles& particles, const std::vector<Vec3>& velocities,
                       std::size_t begin, std::size_t end, std::vector<Vec3>& forces);

}  // namespace engine
