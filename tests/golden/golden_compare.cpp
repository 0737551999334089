// Differences of pixels, and the limits they have to keep.
#include "tests/golden/golden_compare.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <stdexcept>

namespace golden {

Difference differenceOf(const render::Image& actual, const render::Image& expected) {
    if (actual.width != expected.width || actual.height != expected.height)
        throw std::invalid_argument(
            fmt::format("{}x{} against {}x{}", actual.width, actual.height, expected.width, expected.height));
    Difference difference;
    std::size_t noticeable = 0;
    double sum = 0.0;
    for (std::size_t pixel = 0; pixel < actual.rgb.size() / 3; ++pixel) {
        int worst = 0;
        for (std::size_t channel = 3 * pixel; channel < 3 * pixel + 3; ++channel) {
            const int off = std::abs(static_cast<int>(actual.rgb[channel]) - static_cast<int>(expected.rgb[channel]));
            worst = std::max(worst, off);
            sum += off;
        }
        if (worst > kNoticeable) ++noticeable;
        if (worst <= difference.largest) continue;
        difference.largest = worst;
        difference.worstX = static_cast<int>(pixel % static_cast<std::size_t>(actual.width));
        difference.worstY = static_cast<int>(pixel / static_cast<std::size_t>(actual.width));
    }
    const auto channels = static_cast<double>(actual.rgb.size());
    difference.mean = sum / channels;
    difference.share = 3.0 * static_cast<double>(noticeable) / channels;
    return difference;
}

std::string verdict(const Difference& d) {
    std::string reasons;
    if (d.largest > kLargest)
        reasons += fmt::format("largest difference {} at ({}, {}) > {}; ", d.largest, d.worstX, d.worstY, kLargest);
    if (d.mean > kMean) reasons += fmt::format("mean difference {:.4f} > {}; ", d.mean, kMean);
    if (d.share > kShare)
        reasons += fmt::format("{:.3f} % of pixels off by more than {}; ", 100 * d.share, kNoticeable);
    return reasons;
}

render::Image differenceImage(const render::Image& actual, const render::Image& expected) {
    render::Image image = actual;
    for (std::size_t k = 0; k < image.rgb.size(); ++k) {
        const int off = std::abs(static_cast<int>(actual.rgb[k]) - static_cast<int>(expected.rgb[k]));
        image.rgb[k] = static_cast<std::uint8_t>(std::min(255, 16 * off));
    }
    return image;
}

}  // namespace golden
