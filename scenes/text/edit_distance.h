// How far apart two names are, and the known name closest to a mistyped one. Every "did you mean" comes from here.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace scenes {

/// Optimal string alignment distance: the fewest insertions, deletions, replacements and swaps of adjacent characters
/// that turn one text into the other. It is symmetric, and 0 only for equal texts.
std::size_t editDistance(std::string_view a, std::string_view b);

/// The known name with the smallest edit distance to the given one, the first of equals; empty if none is close enough
/// to be a plausible typing mistake.
std::string nearestName(std::string_view name, const std::vector<std::string>& known);

}  // namespace scenes
