// The number of the cell along an axis that a coordinate is in. Used by the cells of the list and by those of births.
#pragma once

#include <algorithm>
#include <cstdint>

namespace engine {

/// Widening of cells that covers the rounding of x / width for any |x| below a thousand million of them.
inline constexpr double kRoundingMargin = 1.0 + 1e-6;

/// Rounded down; far outside all worlds where there are that many cells or no number of them.
/// Shape:  both in meters.
inline std::int64_t cellNumber(double coordinate, double width) {
    constexpr double kFarthest = 1e15;  // a whole number in double
    const double cells = std::max(-kFarthest, std::min(kFarthest, coordinate / width));
    const auto towardZero = static_cast<std::int64_t>(cells);  // one instruction, where floor is a call
    return static_cast<double>(towardZero) > cells ? towardZero - 1 : towardZero;
}

}  // namespace engine
