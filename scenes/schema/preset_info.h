// What is said of the material presets in words: how each looks and moves, and its color. Their constants are in
// engine/force_law/material.cpp.
#pragma once

#include <span>
#include <string_view>

namespace scenes {

/// A material preset in words.
struct PresetInfo {
    std::string_view name;
    std::string_view color;     ///< of its particles, sRGB as "#rrggbb"
    std::string_view behavior;  ///< how it looks and moves, in one line
};

/// All presets, in the order of engine::materialPresets().
std::span<const PresetInfo> presetInfos();

/// The preset with this name, which has to be one of engine::materialPresets().
const PresetInfo& presetInfo(std::string_view name);

}  // namespace scenes
