// The forces on particles that do not come from other particles, as in the paper: weight and the repulsors of
// obstacles. Called by the paper's stepper, symplectic Euler.
#pragma once

#include <cstddef>
#include <vector>

#include "engine/forces/force_field.h"

namespace engine {

/// Adds weight and obstacle forces to the forces (N) on particles begin to end - 1. The result has the bits of the
/// weight and the force of sumContacts() added one after the other, on any instruction set and for any split into
/// ranges.
/// @param velocities  velocities that damping and friction are computed from, in m/s
void addExternalForces(const ForceField& field, const Particles& particles, const std::vector<Vec3>& velocities,
                       std::size_t begin, std::size_t end, std::vector<Vec3>& forces);

}  // namespace engine
