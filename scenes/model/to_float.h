// Converts the simulation's double precision to the renderer's single precision. The simulation itself never uses it.
#pragma once

#include <algorithm>
#include <limits>

#include <glm/glm.hpp>

#include "engine/core/vec3.h"

namespace scenes {

/// The float nearest to a double. Numbers beyond the range of float, which no picture can show, become the largest
/// float.
inline float toFloat(double number) {
    constexpr double kLargest = std::numeric_limits<float>::max();
    return static_cast<float>(std::clamp(number, -kLargest, kLargest));
}

inline glm::vec3 toFloat(const engine::Vec3& vector) {
    return {toFloat(vector.x()), toFloat(vector.y()), toFloat(vector.z())};
}

}  // namespace scenes
