// Motions from the keys of tables, and from the tables of their paths.
#pragma once

#include "engine/obstacles/motion.h"
#include "scenes/build/builders.h"

namespace scenes {

/// How an obstacle moves, from its keys and those of its path. Records problems, and sets the defaults that depend on
/// other keys.
/// @param middle  the point that it turns about by itself, m
engine::Motion motionFrom(Section& section, const engine::Vec3& middle, BuildContext& context);

}  // namespace scenes
