// Measures how much two pictures differ. compare.h checks the measured differences against limits; the studies report
// them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "render/picture/image.h"

namespace render {

/// A pixel in which two pictures differ.
struct PixelDifference {
    int x = 0, y = 0;
    std::array<std::uint8_t, 3> actual{};
    std::array<std::uint8_t, 3> expected{};
    int largest = 0;  ///< largest difference of the pixel's three channels
};

/// How much two pictures differ, in 8-bit steps of a channel, over the pixels that count: all where the mask is not
/// black.
struct PictureMetrics {
    std::size_t pixelCount = 0;          ///< number of pixels where the mask is not black
    std::size_t differing = 0;           ///< number of pixels with any difference
    std::size_t noticeable = 0;          ///< number of pixels with a channel that differs by more than the threshold
    int largest = 0;                     ///< largest difference of any channel
    double mean = 0.0;                   ///< mean difference over all channels of all pixels
    double meanSquare = 0.0;             ///< mean squared difference over all channels of all pixels
    double ssim = 1.0;                   ///< mean structural similarity (Wang et al. 2004); 1 for equal pictures
    std::vector<PixelDifference> worst;  ///< the kWorstPixels pixels with the largest differences, largest first

    /// Share of noticeable pixels among those where the mask is not black; 0 if it is black everywhere.
    double share() const;
    /// Peak signal-to-noise ratio in dB against a peak of 255: 10 log10(255^2 / meanSquare); infinite for equal
    /// pictures.
    double psnr() const;
};

inline constexpr std::size_t kWorstPixels = 5;

/// Measures the differences of two pictures of the same size.
/// @param mask  empty (all pixels count) or of the same size; pixels that are black in it do not count
/// @param threshold  a larger difference of a channel makes its pixel noticeable
/// @throws std::invalid_argument for different sizes
PictureMetrics measure(const Image& actual, const Image& expected, const Image& mask, int threshold);

/// Mean structural similarity of two pictures (Wang et al. 2004) as the ssim filter of ffmpeg defines it for RGB, so
/// that the two implementations can be compared. Windows of 8x8 pixels begin every four pixels from the top left; they
/// are unweighted, variances are unbiased, and the mean is taken over all windows of the three channels of the encoded
/// values. Windows with a pixel that is black in the mask are left out. In a direction of less than eight pixels, a
/// window extends over the whole picture. The result is 1 for equal pictures and where no window is left.
double structuralSimilarity(const Image& actual, const Image& expected, const Image& mask);

}  // namespace render
