// How far apart two names are, and the known name nearest to a mistyped one. Used for every "did you mean".
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace scenes {

/// Insertions, deletions, replacements and swaps of neighbors that turn one text into the other.
/// Holds: symmetric, 0 only for equal texts.
std::size_t editDistance(std::string_view a, std::string_view b);

/// The known name nearest to the given one, the first of equals; empty if none is near enough to be meant.
std::string nearestName(std::string_view name, const std::vector<std::string>& known);

}  // namespace scenes
