// What contacts with obstacles give to particles: the loads of obstacles, of which the audit needs the work.
#pragma once

#include <cstddef>
#include <vector>

#include "engine/core/vec3.h"

namespace engine {

/// The momentum that an obstacle has given to a particle in some time.
struct ContactLoad {
    std::size_t obstacle = 0;      ///< index of the obstacle
    Vec3 impulse = Vec3::Zero();   ///< on the particle, N s
    Vec3 point = Vec3::Zero();     ///< where it acts, m
    Vec3 velocity = Vec3::Zero();  ///< of the obstacle's material there, m/s
    double time = 0.0;             ///< s
};

/// A list of loads that contacts are recorded in.
using ContactLoads = std::vector<ContactLoad>;

}  // namespace engine
