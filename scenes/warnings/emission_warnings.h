// Warnings about emitters that are asked for more particles than find room. Called with the other warnings about the
// start of a scene.
#pragma once

#include <string>
#include <vector>

#include "scenes/model/scene.h"

namespace scenes {

/// Messages on emitters whose rate or interval cannot be kept, each with the position of the [[emitter]] in the scene
/// file and the rate that fits. Obstacles in front of an emitter, and forces, are not considered.
std::vector<std::string> emissionWarnings(const Scene& scene);

}  // namespace scenes
