// How a drawn frame is held against its golden: exact, or within limits that another driver's last bits may need.
#pragma once

#include <string>

#include "render/image.h"

namespace golden {

/// What two pictures of one size differ by, in 8-bit steps of a channel.
struct Difference {
    int largest = 0;
    double mean = 0.0;   ///< over all channels of all pixels
    double share = 0.0;  ///< of pixels with a channel off by more than kNoticeable
    int worstX = 0, worstY = 0;
};

/// Chosen: differences of reciprocals and roots between drivers stay below it, a missing particle does not.
inline constexpr int kNoticeable = 3;
inline constexpr int kLargest = 16;
inline constexpr double kMean = 0.05;
inline constexpr double kShare = 0.005;

/// Throws std::invalid_argument for pictures of different sizes.
Difference differenceOf(const render::Image& actual, const render::Image& expected);

/// Why the difference is too large; empty if it is not.
std::string verdict(const Difference& difference);

/// Absolute differences, sixteen times as bright.
render::Image differenceImage(const render::Image& actual, const render::Image& expected);

}  // namespace golden
