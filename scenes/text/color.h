// Colors as scenes write them. "#rrggbb" is sRGB as every other program shows it; the rest of the project counts in
// linear light.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "engine/core/vec3.h"

namespace scenes {

/// Linear light of an sRGB component, both 0 to 1.
/// Source: IEC 61966-2-1, the piecewise curve.
double linearFromSrgb(double component);

/// "#rrggbb" to linear RGB; nothing for any other text.
std::optional<engine::Vec3> colorFromHex(std::string_view text);

/// Evenly spaced colors, interpolated at a place from 0 (the first) to 1 (the last); places outside take the nearest
/// end.
engine::Vec3 rampColor(const std::vector<engine::Vec3>& colors, double place);

}  // namespace scenes
