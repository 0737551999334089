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
};

/// Every built-in scene except the hard cases, whose pictures do not matter. The frames are early, and expensive scenes
/// have a coarser error, because goldens check that a scene looks the same and its state is the same, not that the
/// simulation is accurate.
const std::vector<GoldenScene>& scenes();

}  // namespace golden
