// Which frames of the built-in scenes are goldens. One table, so that it shows what the suite costs.
#pragma once

#include <string>
#include <vector>

namespace golden {

struct GoldenScene {
    std::string name;  ///< as `globular scenes` lists it
    int first = 0;     ///< frame: the scene has begun to move
    int second = 0;    ///< frame: it has met what it is about, or as much of that as the budget allows
    std::vector<std::string> overrides;
};

/// Every built-in scene but the hard cases, whose pictures nobody looks at. Early frames, and for the dear scenes a
/// coarser error: the goldens are about how things look and that the same state comes again, not about how good it is.
const std::vector<GoldenScene>& scenes();

}  // namespace golden
