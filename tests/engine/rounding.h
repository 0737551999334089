// The unit that tolerances of roundings are counted in.
#pragma once

#include <limits>

inline constexpr double kEps = std::numeric_limits<double>::epsilon();
