// The texts at the scale bar and the color bar of an overlay. Called by build_picture.cpp.
#pragma once

#include <string>
#include <vector>

#include "render/picture/view.h"

namespace scenes {

/// A length in its customary unit: "2 m", "50 cm", "5 mm", "1.5 km".
std::string lengthText(double meters);

/// Two to six ticks of a color bar for values from low to high (m/s or s), at multiples of 1, 2 or 5 times a power of
/// ten. The position of a tick runs from 0 at low to 1 at high.
std::vector<render::Tick> ticksBetween(double low, double high);

}  // namespace scenes
