// Frame rates as scene files and flags write them: "30" or "30000/1001".
#pragma once

#include <optional>
#include <string_view>

#include "render/picture/view.h"

namespace scenes {

/// The frame rate that a whole number or a fraction spells, in lowest terms; nothing for any other text, for zero, and
/// for numbers above a million.
std::optional<render::FrameRate> frameRateFrom(std::string_view text);

}  // namespace scenes
