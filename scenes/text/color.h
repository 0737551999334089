// Colors as scene files write them ("#rrggbb" in sRGB), color ramps, and the built-in color maps. Everything returned
// here is linear RGB, which is what the rest of the program computes with.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "engine/core/vec3.h"

namespace scenes {

/// Converts an sRGB component to linear light, both in [0,1], by the piecewise curve of IEC 61966-2-1.
double linearFromSrgb(double component);

/// A linear color as sRGB, 0 to 255 for each component.
std::array<std::uint8_t, 3> srgbBytes(const engine::Vec3& linear);

/// Converts "#rrggbb" to linear RGB; returns nothing for any other text.
std::optional<engine::Vec3> colorFromHex(std::string_view text);

/// Interpolates linearly between evenly spaced colors.
/// @param parameter  0 gives the first color, 1 the last; values outside are clamped, and NaN gives the first color
engine::Vec3 rampColor(const std::vector<engine::Vec3>& colors, double parameter);

/// Names of the built-in, perceptually uniform color maps: "lagoon", "ember", "dusk", "glacier".
std::vector<std::string_view> colorMapNames();

/// Evenly spaced colors of a color map from its dark end to its light end, linear RGB in [0,1].
/// @pre count >= 2
/// @throws std::logic_error if there is no color map of that name
std::vector<engine::Vec3> colorMap(std::string_view name, int count = 256);

}  // namespace scenes
