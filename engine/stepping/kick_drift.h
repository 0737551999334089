// The vectorized loop of the paper's stepper: what happens to each particle once the forces are known.
#pragma once

#include <cstddef>
#include <vector>

#include "engine/state/particles.h"

namespace engine {

/// Parameters of one step, the same for every particle.
struct KickDrift {
    double h = 0.0;                   ///< s
    double decay = 1.0;               ///< factor by which drag reduces velocities over the step
    Vec3 gravity = Vec3::Zero();      ///< m/s^2
    const std::vector<Vec3>& forces;  ///< N, by particle index
    bool hasWeight = false;           ///< whether the forces include gravity already
};

/// Kicks particles begin to end - 1 and lets them drift: v becomes decay (v + h/m F), where F is force and weight, and
/// x becomes x + h v. Returns whether all of them are valid (state_checks.h). The bits are the same on any instruction set and for any split of the particles into ranges.
bool kickAndDrift(const KickDrift& step, std::size_t begin, std::size_t end, Particles& particles);

}  // namespace engine
