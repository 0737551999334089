// Draws the frames that the golden suite compares, as the program would draw them. Both styles of a frame come from one
// simulation.
#pragma once

#include <filesystem>

#include "tests/golden/golden_scenes.h"

namespace golden {

/// Whether the build has OSMesa, which draws the goldens by OpenGL.
bool canDrawWithOpenGl();

/// Writes the pictures below the folder by their names, each with a sidecar, so that `globular approve` knows its
/// provenance. Those by OpenGL are drawn if canDrawWithOpenGl().
/// @param timeCount  1 for the first frame of each scene only, 2 for both
void draw(const std::vector<GoldenScene>& scenes, std::size_t timeCount, const std::filesystem::path& folder);

}  // namespace golden
