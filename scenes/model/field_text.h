// Fields of a scene in words, for globular check.
#pragma once

#include <string>

#include "engine/state/fields.h"

namespace scenes {

/// "(0, 0.5, 2)", with four digits of each number.
std::string vectorText(const engine::Vec3& vector);

/// What a field does, and where and when: "wind of (2, 0, 0) m/s, which takes 0.5 s to drag along two thirds, above
/// (0, 1, 0) m, until 2 s".
std::string fieldText(const engine::Field& field);

}  // namespace scenes
