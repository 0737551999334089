// What contacts with obstacles give to particles: the loads of obstacles, of which the audit needs the work.
#pragma once

#include <cstddef>
#include <mutex>
#include <vector>

#include "engine/core/vec3.h"

namespace engine {

/// The momentum that an obstacle has given to a particle in some time.
struct ContactLoad {
    std::size_t obstacle = 0;      ///< index of the obstacle
    Vec3 impulse = Vec3::Zero();   ///< on the particle, N s
    Vec3 point = Vec3::Zero();     ///< where it acts: the center of the particle, m
    Vec3 velocity = Vec3::Zero();  ///< of the obstacle's material there, m/s
    double time = 0.0;             ///< s
};

/// A list of loads that contacts are recorded in.
using ContactLoads = std::vector<ContactLoad>;

/// A list of loads that several threads add to. It stays with its object: a copy has none.
class SharedLoads {
 public:
    SharedLoads() = default;
    SharedLoads(const SharedLoads& /*other*/) {}
    SharedLoads& operator=(const SharedLoads& /*other*/) { return *this; }
    ~SharedLoads() = default;

    void add(const ContactLoads& loads) {
        const std::lock_guard lock(mutex_);
        list_.insert(list_.end(), loads.begin(), loads.end());
    }

    /// The loads in no particular order; for one thread at a time.
    ContactLoads& list() { return list_; }

 private:
    std::mutex mutex_;
    ContactLoads list_;
};

}  // namespace engine
