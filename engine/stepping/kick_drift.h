// What a step of the paper's method does to each particle once forces are known.
#pragma once

#include <cstddef>
#include <vector>

#include "engine/core/bounding_box.h"
#include "engine/state/particles.h"

namespace engine {

/// One step, for every particle alike.
struct KickDrift {
    double h = 0.0;                   ///< s
    double decay = 1.0;               ///< of velocities over a step
    Vec3 gravity = Vec3::Zero();      ///< m/s^2
    const std::vector<Vec3>& forces;  ///< N, by particle index
    bool hasWeight = false;           ///< is among the forces already
};

/// What is known of particles that have been moved.
struct Moved {
    bool areValid = true;                           ///< all of them (soundness.h)
    BoundingBox velocities = BoundingBox::empty();  ///< the box around theirs, m/s, if they are sound

    void include(const Moved& others) {
        areValid &= others.areValid;
        velocities.include(others.velocities);
    }
};

/// Kicks particles begin to end - 1 and lets them drift: v becomes decay (v + h/m F), where F is their force and
/// weight, x becomes x + h v.
/// Holds:  the same bits on any instruction set, and however particles are split up into ranges.
Moved kickAndDrift(const KickDrift& step, std::size_t begin, std::size_t end, Particles& particles);

}  // namespace engine
