// The light that a body gives off because it is hot, as eyes see it.
#pragma once

#include <vector>

#include "engine/core/vec3.h"

namespace scenes {

/// Tristimulus values X, Y, Z (CIE 1931) of the light that a black body radiates, by Planck's law. Y is its luminance
/// in cd/m^2. The color matching functions are the sums of Gaussians of Wyman, Sloan and Shirley 2013 ("Simple Analytic
/// Approximations to the CIE XYZ Color Matching Functions").
/// @param temperature  K; nothing is radiated at 0 and below
engine::Vec3 blackBodyXyz(double temperature);

/// Colors for evenly spaced temperatures whose squares are the light of a black body, in linear RGB, relative to the
/// largest component at the highest temperature. Squares, because glowing particles radiate the square of their color
/// (section 3 of render/picture/shading_model.h). What is outside of the gamut of sRGB is clipped: the blue of red
/// heat.
/// @param low, high  first and last temperature, K
/// @pre count >= 2, high > 0
std::vector<engine::Vec3> blackBodyRamp(double low, double high, int count = 256);

}  // namespace scenes
