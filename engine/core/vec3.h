// The vector type of the simulation, and those operations whose order of summation must be fixed so that a scene gives
// the same bits on every machine. Used by every file of the engine.
#pragma once

#include <Eigen/Geometry>

namespace engine {

using Vec3 = Eigen::Vector3d;
using Matrix3 = Eigen::Matrix3d;

/// Dot product, summed x, y, z in that order on every target.
inline double dot(const Vec3& a, const Vec3& b) {
    return (a.x() * b.x() + a.y() * b.y()) + a.z() * b.z();
}

/// Squared length of a vector, with the components summed in the order x, y, z.
inline double squaredLength(const Vec3& a) {
    return dot(a, a);
}

}  // namespace engine
