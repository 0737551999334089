// Single pictures of a scene at chosen times, drawn in one simulation: stills, and strips of several panels. Called by
// `strip` and `figures`.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "render/picture/image.h"
#include "tools/run/options.h"

namespace tools {

/// The frames to draw: one for a still, several for a strip, or both.
struct StillSelection {
    std::optional<int> stillFrame;
    std::vector<int> stripFrames;  ///< numbers of the strip's frames, ascending
};

struct StillPictures {
    render::Image still;    ///< picture of the still; empty if no still was selected
    render::Image strip;    ///< picture of the strip; empty if no strip was selected
    std::string stateHash;  ///< hash of the particles at the last frame drawn
};

/// Simulates up to the last selected frame and draws the selected ones. The panels of a strip have their time below
/// them and no time stamp. The color bar is on the last panel; the scale bar is on the first, or on each if the camera
/// moves.
/// @throws engine::InstabilityError, render::SystemError
/// @throws scenes::InputError if the strip would have too many pixels
StillPictures drawStills(const DrawJob& job, const StillSelection& selection);

}  // namespace tools
