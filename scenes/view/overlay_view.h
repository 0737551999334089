// What a scene's overlay says at a moment: texts and ticks, as the renderer takes them.
#pragma once

#include <string>
#include <vector>

#include "render/picture/view.h"
#include "scenes/model/scene.h"

namespace scenes {

/// Empty where the scene asks for none. time: s.
render::Overlay overlayOf(const Scene& scene, double time);

/// "t = 1.25 s", with as many decimals as tell the frames of the scene apart, at least two.
std::string timeText(const Scene& scene, double time);

/// "2 m", "50 cm", "5 mm", "1.5 km".
std::string lengthText(double meters);

/// Two to six numbers a reader expects, multiples of 1, 2 or 5 times a power of ten, from low to high, both in m/s or
/// s; places from 0 at low to 1 at high.
std::vector<render::Tick> ticksBetween(double low, double high);

}  // namespace scenes
