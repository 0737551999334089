// Outlines of letters.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "scenes/shapes/extrusion.h"

namespace scenes {

/// The outlines of one or more lines of UTF-8 text, each centered, around the middle of their bounds. Empty for a text
/// of spaces.
/// @param height  of a capital H, in m
/// @param font  the bytes of a TrueType or OpenType font; empty for DejaVu Sans, which is built in
/// Throws InputError, which names the source, if the font cannot be read or lacks a character.
Outline textOutline(std::string_view text, double height, const std::vector<std::uint8_t>& font,
                    const std::string& source);

}  // namespace scenes
