// Double to single precision, for what goes to the renderer. Used where views are made, and nowhere else.
#pragma once

#include <algorithm>
#include <limits>

#include <glm/glm.hpp>

#include "engine/core/vec3.h"

namespace scenes {

/// The nearest float; numbers beyond its range, which no picture can show, take its largest.
inline float single(double number) {
    constexpr double kLargest = std::numeric_limits<float>::max();
    return static_cast<float>(std::clamp(number, -kLargest, kLargest));
}

inline glm::vec3 single(const engine::Vec3& vector) {
    return {single(vector.x()), single(vector.y()), single(vector.z())};
}

}  // namespace scenes
