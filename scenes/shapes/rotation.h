// Rotations by angles in degrees, by sums and products alone, so that they are the same on every machine.
#pragma once

#include "engine/core/vec3.h"

namespace scenes {

/// Cosine and sine of an angle.
struct CosSin {
    double cos = 1.0;
    double sin = 0.0;
};

/// Cosine and sine of an angle in degrees, to within 2e-16; exact for multiples of 90 degrees.
CosSin cosSinOfDegrees(double degrees);

/// The rotation about the x axis, then the y axis, then the z axis, by the components of the vector in degrees.
/// Positive angles turn counterclockwise as seen from the positive end of the axis.
engine::Matrix3 rotationOfDegrees(const engine::Vec3& degrees);

/// The product of a matrix and a vector, with the terms of each component summed from left to right.
engine::Vec3 transformed(const engine::Matrix3& matrix, const engine::Vec3& vector);

}  // namespace scenes
