// The vector type of the simulation, and the few operations whose order of summation is part of the promise that a
// scene gives the same bits everywhere. Used by every file of the engine.
#pragma once

#include <Eigen/Geometry>

namespace engine {

using Vec3 = Eigen::Vector3d;
using Matrix3 = Eigen::Matrix3d;

/// Dot product, summed x, y, z in that order on every target.
inline double dot(const Vec3& a, const Vec3& b) {
    return (a.x() * b.x() + a.y() * b.y()) + a.z() * b.z();
}

/// Squared length, summed like dot().
inline double squaredLength(const Vec3& a) {
    return dot(a, a);
}

}  // namespace engine
