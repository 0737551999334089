// Perceptually uniform color maps, made rather than stored: each is a curve through OKLab of which equal parts look
// equally different, while lightness grows evenly from end to end.
#pragma once

#include <string_view>
#include <vector>

#include "engine/core/vec3.h"

namespace scenes {

/// Their names, which are our own: "lagoon", "ember", "dusk", "glacier".
const std::vector<std::string_view>& colorMapNames();

/// Evenly spaced colors of a map from its dark end to its light one, linear RGB within [0,1]. Shape: count >= 2.
/// Throws:  std::logic_error for a name that is none of them.
std::vector<engine::Vec3> colorMap(std::string_view name, int count = 256);

}  // namespace scenes
