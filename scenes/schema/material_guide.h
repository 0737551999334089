// What the presets and the constants of a material do to the eye: a part of what `globular schema` prints. The numbers
// are those of engine::materialPresets().
#pragma once

#include <string>

namespace scenes {

/// The presets as text for a terminal: two lines for each, its behavior and its constants.
std::string presetsText();

/// Two sections of docs/scenes.md: the presets, and what the constants do, with a picture.
std::string materialGuideMarkdown();

}  // namespace scenes
