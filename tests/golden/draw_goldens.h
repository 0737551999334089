// Draws the frames that the golden suite compares, as the program would draw them. Both styles of a frame come from one
// simulation.
#pragma once

#include <filesystem>

#include "tests/golden/golden_scenes.h"

namespace golden {

/// Writes SCENE/STYLE/frame-NNNNN.png below the folder, each with a sidecar, so that `globular approve` knows its
/// provenance.
/// @param timeCount  1 for the first frame of each scene only, 2 for both
void draw(const std::vector<GoldenScene>& scenes, std::size_t timeCount, const std::filesystem::path& folder);

}  // namespace golden
