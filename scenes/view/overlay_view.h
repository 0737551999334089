// The overlay of a frame (time stamp, scale bar, color bar) as texts and ticks for the renderer.
#pragma once

#include <string>
#include <vector>

#include "render/picture/view.h"
#include "scenes/model/scene.h"

namespace scenes {

/// The overlay at a time in s. It is empty where the scene has none.
render::Overlay overlayOf(const Scene& scene, double time);

/// "t = 1.25 s", with as many decimals as distinguish the frames of the scene, at least two.
std::string timeText(const Scene& scene, double time);

/// A length in its customary unit: "2 m", "50 cm", "5 mm", "1.5 km".
std::string lengthText(double meters);

/// Two to six ticks at multiples of 1, 2 or 5 times a power of ten, for an axis from low to high (m/s or s). The
/// position of a tick runs from 0 at low to 1 at high.
std::vector<render::Tick> ticksBetween(double low, double high);

}  // namespace scenes
