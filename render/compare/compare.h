// Whether two pictures are the same within limits and which limit decided, and pictures that show the differences. Used
// by the compare and approve commands and by the golden suite.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "render/compare/picture_metrics.h"

namespace render {

/// The limits that two pictures must all keep to pass. Differences are in 8-bit steps of a channel.
struct CompareLimits {
    int threshold = 0;   ///< a pixel counts as noticeable when one of its channels differs by more
    double share = 0.0;  ///< largest share of pixels that may be noticeable
    int largest = 0;     ///< largest difference of any channel
    double mean = 0.0;   ///< largest mean difference over all channels of all pixels
    double ssim = 1.0;   ///< least structural similarity
};

inline constexpr const char* kProfileNames = "strict, vendor, loose";

/// The limits of a profile. strict: the same pixels. vendor: roundings of another OpenGL driver, up to 3/255, with
/// larger differences on at most 0.5 % of the pixels and none above 16/255. loose: the same picture at a glance, for
/// example with other antialiasing.
/// @throws std::invalid_argument for another name
CompareLimits limitsOf(std::string_view profile);

/// What decides a comparison, in the order of the checks.
enum class CompareRule { identical, size, largest, share, mean, ssim, withinLimits };

/// "identical", "size", "largest", "share", "mean", "ssim" or "within-limits".
const char* nameOf(CompareRule rule);

struct Comparison {
    CompareRule rule = CompareRule::identical;  ///< the first limit that is exceeded, otherwise how the picture passed
    std::vector<std::string> reasons;           ///< a sentence for each limit that is exceeded; empty if it passed
    PictureMetrics metrics;                     ///< default values for pictures of different sizes

    bool passed() const { return reasons.empty(); }
};

/// Compares two pictures. Only if they differ are the limits checked.
/// @param mask  empty, or a picture of the same size whose black pixels do not count
/// @throws std::invalid_argument for a mask of another size than the expected picture
Comparison compare(const Image& actual, const Image& expected, const CompareLimits& limits, const Image& mask = {});

/// Absolute differences of the channels, sixteen times as bright.
/// @pre both pictures have the same size
Image differenceImage(const Image& actual, const Image& expected);

/// The largest difference of each pixel's channels on a logarithmic color scale, dark blue for 1 and white for 255.
/// Equal pixels show the expected picture in dark gray, so that one sees where in the picture the differences are.
/// @pre both pictures have the same size
Image heatMap(const Image& actual, const Image& expected);

}  // namespace render
