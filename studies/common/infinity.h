// What no run reaches and every minimum starts from.
#pragma once

#include <limits>

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();
