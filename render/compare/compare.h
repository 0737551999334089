// Whether two pictures are the same within limits, and which rule decided. Used by `globular compare` and the golden
// suite.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "render/compare/picture_metrics.h"

namespace render {

/// What may differ, in 8-bit steps of a channel. A picture passes when it keeps all of them.
struct CompareLimits {
    int threshold = 0;   ///< a pixel counts as noticeable when one of its channels is off by more
    double share = 0.0;  ///< of pixels that may be noticeable
    int largest = 0;     ///< of any channel
    double mean = 0.0;   ///< over all channels of all pixels
    double ssim = 1.0;   ///< at least
};

inline constexpr const char* kProfileNames = "strict, vendor, loose";

/// The limits of a profile. strict: the same bytes. vendor: the last bits of another OpenGL driver, 3/255 on at most
/// 0.5 % of pixels and none above 16/255. loose: the same picture at a glance, as with other antialiasing. Throws:
/// std::invalid_argument for another name.
CompareLimits limitsOf(std::string_view profile);

/// What decides a comparison, in the order in which they are asked.
enum class CompareRule { identical, size, largest, share, mean, ssim, withinLimits };

/// "identical", "size", "largest", "share", "mean", "ssim", "within-limits".
const char* nameOf(CompareRule rule);

struct Comparison {
    CompareRule rule = CompareRule::identical;  ///< that decided: the first limit that is broken, else how it passed
    std::vector<std::string> reasons;           ///< a sentence for every limit that is broken; empty if it passed
    PictureMetrics metrics;                     ///< not filled in for different sizes

    bool passed() const { return reasons.empty(); }
};

/// Exact first; otherwise every limit. Shape: mask is empty or a picture of the same size whose black pixels do not
/// count. Throws: std::invalid_argument for a mask of another size than the expected picture.
Comparison compare(const Image& actual, const Image& expected, const CompareLimits& limits, const Image& mask = {});

}  // namespace render
