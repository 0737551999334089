// Which frames of the built-in scenes are goldens, in one table that shows what the suite costs.
#pragma once

#include <string>
#include <vector>

namespace golden {

struct GoldenScene {
    std::string name;  ///< as `globular scenes` lists it
    int first = 0;     ///< frame: the scene has begun to move
    int second = 0;  ///< frame: what the scene is about has happened, or as much of it as the time of the suite allows
    std::vector<std::string> overrides;
    bool isDrawnWithOpenGl = false;  ///< whether OpenGL draws the second frame, too: the paper's figures and materials
};

/// The name of a golden: its path below the folder of goldens.
/// @param renderer  as sidecars record it, "cpu" or "opengl"
std::string goldenName(const GoldenScene& scene, const std::string& style, int frame, const std::string& renderer);

/// Every built-in scene except the hard cases, whose pictures do not matter. The frames are early, and expensive scenes
/// have a coarser error, because goldens check that a scene looks the same and its state is the same, not that the
/// simulation is accurate.
const std::vector<GoldenScene>& scenes();

}  // namespace golden
