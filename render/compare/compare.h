// Decides whether two pictures are the same within limits, says which limit decided, and makes images that show the
// differences. Used by the compare and approve commands and by the tests of golden frames.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "render/compare/picture_metrics.h"

namespace render {

/// The limits that two pictures must all keep to pass. Differences are in 8-bit steps of a channel.
struct CompareLimits {
    int threshold = 0;   ///< a pixel with a channel that differs by more counts as noticeable
    double share = 0.0;  ///< largest share of noticeable pixels that passes
    int largest = 0;     ///< largest difference of any channel that passes
    double mean = 0.0;   ///< largest mean difference over all channels of all pixels that passes
    double ssim = 1.0;   ///< smallest structural similarity that passes
};

/// The limits of a profile. strict: the same pixels. vendor: roundings of another OpenGL driver, up to 3/255, with
/// larger differences on at most 0.5 % of the pixels and none above 16/255. renderer: the same view by the renderer on
/// the CPU and by that in OpenGL, up to 6/255, with larger differences on at most 1 % of the pixels and none above
/// 64/255. loose: the same picture at a glance, for
/// example with other antialiasing.
/// @throws std::invalid_argument for another name
CompareLimits limitsOf(std::string_view profile);

/// What decides a comparison of two pictures: one of the limits, in the order in which they are checked, or that none
/// is exceeded.
enum class CompareRule { identical, size, largest, share, mean, ssim, withinLimits };

/// Name of the rule in reports: "identical", "size", "largest", "share", "mean", "ssim" or "within-limits".
const char* nameOf(CompareRule rule);

struct Comparison {
    CompareRule rule =
        CompareRule::identical;        ///< the first limit that is exceeded; if none is, identical or withinLimits
    std::vector<std::string> reasons;  ///< a sentence for each limit that is exceeded; empty if it passed
    PictureMetrics metrics;            ///< the measured differences; default values for pictures of different sizes

    bool passed() const { return reasons.empty(); }
};

/// Compares two pictures. The limits are checked only if the pictures differ.
/// @param mask  empty, or a picture of the same size; pixels that are black in it do not count
/// @throws std::invalid_argument for a mask of another size than the expected picture
Comparison compare(const Image& actual, const Image& expected, const CompareLimits& limits, const Image& mask = {});

/// An image of the absolute differences of the channels of two pictures, sixteen times as bright.
/// @pre both pictures have the same size
Image differenceImage(const Image& actual, const Image& expected);

/// An image of the largest difference of each pixel's channels between two pictures on a logarithmic color scale, dark
/// blue for 1 and white for 255. Equal pixels show the expected picture in dark gray, so that one sees where in the
/// picture the differences are.
/// @pre both pictures have the same size
Image heatMap(const Image& actual, const Image& expected);

}  // namespace render
