// What `check` says of obstacles and emitters in motion.
#pragma once

#include <string>

#include "scenes/model/scene.h"
#include "tools/system/json.h"

namespace tools {

/// A JSON list of what moves in a scene, with the members of scenes::MotionNote.
Json motionsJson(const scenes::Scene& scene);

/// The list as text: a line for each, up to as many as one reads.
std::string motionsText(const Json& motions);

}  // namespace tools
