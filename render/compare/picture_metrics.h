// Numbers for how far two pictures are apart. compare.h holds them against limits.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "render/picture/image.h"

namespace render {

/// One pixel in which two pictures differ.
struct PixelDifference {
    int x = 0, y = 0;
    std::array<std::uint8_t, 3> actual{};
    std::array<std::uint8_t, 3> expected{};
    int largest = 0;  ///< over the three channels
};

/// Differences are in 8-bit steps of a channel, over the pixels that count.
struct PictureMetrics {
    std::size_t pixelCount = 0;          ///< that count
    std::size_t differing = 0;           ///< with any difference
    std::size_t noticeable = 0;          ///< with a channel off by more than the threshold
    int largest = 0;                     ///< of all channels of all pixels
    double mean = 0.0;                   ///< over all channels of all pixels
    double meanSquare = 0.0;             ///< likewise
    double ssim = 1.0;                   ///< see structuralSimilarity
    std::vector<PixelDifference> worst;  ///< at most kWorstPixels, the worst first, equals in reading order

    /// Share of pixels that are noticeable; 0 where none count.
    double share() const;
    /// Peak signal-to-noise ratio in dB against a peak of 255: 10 log10(255^2 / meanSquare); infinite without a
    /// difference.
    double psnr() const;
};

inline constexpr std::size_t kWorstPixels = 5;

/// Differences of two pictures of one size. Shape: mask is empty (all pixels count) or of their size; its black pixels
/// do not count. Throws: std::invalid_argument for different sizes.
PictureMetrics measure(const Image& actual, const Image& expected, const Image& mask, int threshold);

/// Mean structural similarity (Wang et al. 2004) as the ssim filter of ffmpeg defines it for RGB, so that its numbers
/// can be compared: windows of 8x8 pixels every four pixels from the top left, unweighted, with unbiased variances; the
/// mean over all windows, then over the three channels of the encoded values. Windows with a pixel that does not count
/// are left out. A picture below eight pixels in a direction has windows of its whole extent there. 1 for equal
/// pictures, and where no window is left.
double structuralSimilarity(const Image& actual, const Image& expected, const Image& mask);

}  // namespace render
