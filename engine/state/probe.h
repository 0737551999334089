// What the contacts with obstacles need of a particle of a simulation.
#pragma once

#include <cstddef>
#include <vector>

#include "engine/force_law/material.h"
#include "engine/obstacles/obstacles.h"
#include "engine/state/particles.h"

namespace engine {

/// A particle as its contacts see it.
/// @param velocity  from which damping and friction are computed, m/s
/// @param time      at which the obstacles are met, s
/// @param index     of its material
inline Probe probeOf(const std::vector<Material>& materials, const Particles& particles, std::size_t p,
                     std::uint32_t index, const Vec3& velocity, double time) {
    const Material& material = materials[index];
    return {particles.position[p], velocity,          particles.radius[p],
            material.dampingReach, material.friction, particles.mass[p],
            material.repulsion,    material.damping,  time,
            material.cohesion};
}

/// The same for the material that the particle has.
inline Probe probeOf(const std::vector<Material>& materials, const Particles& particles, std::size_t p,
                     const Vec3& velocity, double time) {
    return probeOf(materials, particles, p, particles.material[p], velocity, time);
}

}  // namespace engine
