// The vectorized update of velocities and positions in the paper's stepper (equations 7 and 8) from known forces.
#pragma once

#include <cstddef>
#include <vector>

#include "engine/state/particles.h"

namespace engine {

/// Parameters of one step of the paper's stepper, the same for every particle.
struct KickDrift {
    double h = 0.0;                   ///< s
    double decay = 1.0;               ///< factor by which drag multiplies velocities in the step
    Vec3 gravity = Vec3::Zero();      ///< m/s^2
    const std::vector<Vec3>& forces;  ///< force on each particle, by particle index, N
    bool hasWeight = false;           ///< whether the forces include the weights already
};

/// Updates the velocities and then the positions of particles begin to end - 1: v becomes decay (v + h/m F), where F is
/// the force including weight, and x becomes x + h v. Returns whether the new positions and velocities are all valid
/// (see state_checks.h). The result has the same bits on any instruction set and for any split of the particles into
/// ranges.
bool kickAndDrift(const KickDrift& step, std::size_t begin, std::size_t end, Particles& particles);

}  // namespace engine
