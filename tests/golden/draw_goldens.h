// Draws the frames of the table as the program would, both styles of a frame from one simulation.
#pragma once

#include <filesystem>

#include "tests/golden/golden_scenes.h"

namespace golden {

/// Writes SCENE/STYLE/frame-NNNNN.png below the folder, each with its sidecar, so that `globular approve` knows where
/// it comes from; of the first moment or of both.
void draw(const std::vector<GoldenScene>& scenes, std::size_t moments, const std::filesystem::path& folder);

}  // namespace golden
