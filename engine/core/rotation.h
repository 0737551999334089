// Rotations by angles and about axes, by own arithmetic, so that they are the same on every machine.
#pragma once

#include "engine/core/sine.h"
#include "engine/core/vec3.h"

namespace engine {

/// The rotation about a coordinate axis (0, 1, 2) by an angle in degrees, exact for quarter turns. Positive angles turn
/// counterclockwise as seen from the positive end of the axis.
inline Matrix3 rotationAboutAxis(int axis, double degrees) {
    const auto [sine, cosine] = sineAndCosineOfDegrees(degrees);
    const int next = (axis + 1) % 3;
    const int last = (axis + 2) % 3;
    Matrix3 rotation = Matrix3::Identity();
    rotation(next, next) = cosine;
    rotation(next, last) = -sine;
    rotation(last, next) = sine;
    rotation(last, last) = cosine;
    return rotation;
}

/// The rotation about the x axis, then the y axis, then the z axis, by the components of the vector in degrees.
inline Matrix3 rotationOfDegrees(const Vec3& degrees) {
    return rotationAboutAxis(2, degrees.z()) * (rotationAboutAxis(1, degrees.y()) * rotationAboutAxis(0, degrees.x()));
}

/// The rotation about an axis, a unit vector, by an angle in radians.
inline Matrix3 rotationAbout(const Vec3& axis, double angle) {
    const auto [sine, cosine] = sineAndCosine(angle);
    Matrix3 cross;
    cross << 0.0, -axis.z(), axis.y(), axis.z(), 0.0, -axis.x(), -axis.y(), axis.x(), 0.0;
    return cosine * Matrix3::Identity() + sine * cross + (1.0 - cosine) * (axis * axis.transpose());
}

}  // namespace engine
