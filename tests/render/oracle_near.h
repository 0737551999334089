// Comparison within a tolerance, for the oracle's own tests; a failure prints both values, their difference and the
// tolerance.
#pragma once

#include <cmath>
#include <limits>

#include <glm/glm.hpp>
#include "tests/catch.h"

namespace oracle {

constexpr double kEps = std::numeric_limits<double>::epsilon();      ///< relative rounding of double
constexpr double kFloatEps = std::numeric_limits<float>::epsilon();  ///< relative rounding of the float inputs

inline void checkNear(double value, double expected, double tolerance) {
    const double difference = value - expected;
    INFO(value << ", expected " << expected << ", difference " << difference << ", tolerance " << tolerance);
    CHECK(std::abs(difference) <= tolerance);
}

inline void checkNear(const glm::dvec3& value, const glm::dvec3& expected, double tolerance) {
    for (int axis = 0; axis < 3; ++axis) {
        INFO("component " << axis);
        checkNear(value[axis], expected[axis], tolerance);
    }
}

}  // namespace oracle
