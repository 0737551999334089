// Measures the differences of two pictures in two passes over their pixels: one for the differences of channels, one
// for the windows of the structural similarity.
#include "render/compare/picture_metrics.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <stdexcept>

namespace render {
namespace {

void requireOneSize(const Image& a, const Image& b) {
    if (a.width != b.width || a.height != b.height)
        throw std::invalid_argument(fmt::format("{}x{} against {}x{}", a.width, a.height, b.width, b.height));
}

bool counts(const Image& mask, std::size_t pixel) {
    if (mask.rgb.empty()) return true;
    return mask.rgb[3 * pixel] != 0 || mask.rgb[3 * pixel + 1] != 0 || mask.rgb[3 * pixel + 2] != 0;
}

PixelDifference differenceAt(const Image& actual, const Image& expected, std::size_t pixel) {
    PixelDifference difference;
    difference.x = static_cast<int>(pixel % static_cast<std::size_t>(actual.width));
    difference.y = static_cast<int>(pixel / static_cast<std::size_t>(actual.width));
    for (std::size_t channel = 0; channel < 3; ++channel) {
        difference.actual[channel] = actual.rgb[3 * pixel + channel];
        difference.expected[channel] = expected.rgb[3 * pixel + channel];
        difference.largest =
            std::max(difference.largest, std::abs(int{difference.actual[channel]} - int{difference.expected[channel]}));
    }
    return difference;
}

/// Inserts a pixel into the short list of those with the largest differences, sorted from the largest down. Pixels are
/// added in reading order, and the upper bound keeps that order among equal differences.
void keepWorst(std::vector<PixelDifference>& worst, const PixelDifference& difference) {
    if (worst.size() == kWorstPixels && difference.largest <= worst.back().largest) return;
    const auto position = std::upper_bound(worst.begin(), worst.end(), difference,
                                           [](const auto& a, const auto& b) { return a.largest > b.largest; });
    worst.insert(position, difference);
    if (worst.size() > kWorstPixels) worst.pop_back();
}

/// Sums over the pixels of a window in one channel of pictures a and b, for means and variances. The sum of 64 squared
/// bytes is far below the limit of 64 bits.
struct Sums {
    std::int64_t count = 0, a = 0, b = 0, squares = 0, product = 0;

    Sums& operator+=(const Sums& other) {
        count += other.count;
        a += other.a;
        b += other.b;
        squares += other.squares;
        product += other.product;
        return *this;
    }
};

/// Structural similarity of pictures a and b in one window,
///   (2 m_a m_b + c1)(2 s_ab + c2) / ((m_a^2 + m_b^2 + c1)(s_a^2 + s_b^2 + c2)),
/// with means m and unbiased (co)variances s. Both constants are those of ffmpeg: c2 is Wang's (0.03 * 255)^2 with
/// ffmpeg's rounding, c1 a 64th of Wang's (0.01 * 255)^2, which makes the measure stricter in dark flat windows.
double similarity(const Sums& sums) {
    constexpr double c1 = 416.0 / (64.0 * 64.0);
    constexpr double c2 = 235963.0 / (64.0 * 63.0);
    const auto n = static_cast<double>(sums.count);
    const double degrees = std::max(1.0, n - 1.0);
    const double meanA = static_cast<double>(sums.a) / n;
    const double meanB = static_cast<double>(sums.b) / n;
    // Variance and covariance are computed in integers up to the last division, so that equal pictures give exactly 1.
    const auto spread = static_cast<double>(sums.count * sums.squares - sums.a * sums.a - sums.b * sums.b);
    const auto joint = static_cast<double>(sums.count * sums.product - sums.a * sums.b);
    return (2.0 * meanA * meanB + c1) * (2.0 * joint / (n * degrees) + c2) /
           ((meanA * meanA + meanB * meanB + c1) * (spread / (n * degrees) + c2));
}

/// The windows of the structural similarity along one direction of a picture. A window is two blocks of four pixels
/// each, and one begins at every block but the last. A picture with less than eight pixels in this direction has one
/// window of one block.
struct Blocks {
    explicit Blocks(int extent)
        : size(extent < 8 ? std::max(1, extent) : 4), perWindow(extent < 8 ? 1 : 2), count(extent / size) {}
    int size, perWindow, count;
    int windowCount() const { return count - perWindow + 1; }
};

/// The sums over a block of pixels in one channel; all 0 if the mask is black at one of its pixels.
/// @param block  left, top, width and height in pixels, and the channel
Sums blockSums(const Image& actual, const Image& expected, const Image& mask, std::array<int, 5> block) {
    const auto [left, top, width, height, channel] = block;
    Sums sums;
    for (int y = top; y < top + height; ++y)
        for (int x = left; x < left + width; ++x) {
            const auto pixel =
                static_cast<std::size_t>(y) * static_cast<std::size_t>(actual.width) + static_cast<std::size_t>(x);
            if (!counts(mask, pixel)) return {};
            const std::int64_t a = actual.rgb[3 * pixel + static_cast<std::size_t>(channel)];
            const std::int64_t b = expected.rgb[3 * pixel + static_cast<std::size_t>(channel)];
            sums += {1, a, b, a * a + b * b, a * b};
        }
    return sums;
}

}  // namespace

double PictureMetrics::share() const {
    return pixelCount == 0 ? 0.0 : static_cast<double>(noticeable) / static_cast<double>(pixelCount);
}

double PictureMetrics::psnr() const {
    if (meanSquare == 0.0) return std::numeric_limits<double>::infinity();
    return 10.0 * std::log10(255.0 * 255.0 / meanSquare);
}

PictureMetrics measure(const Image& actual, const Image& expected, const Image& mask, int threshold) {
    requireOneSize(actual, expected);
    if (!mask.rgb.empty()) requireOneSize(mask, expected);
    PictureMetrics metrics;
    std::uint64_t sum = 0, squares = 0;
    for (std::size_t pixel = 0; pixel < expected.rgb.size() / 3; ++pixel) {
        if (!counts(mask, pixel)) continue;
        ++metrics.pixelCount;
        const PixelDifference difference = differenceAt(actual, expected, pixel);
        if (difference.largest == 0) continue;
        ++metrics.differing;
        if (difference.largest > threshold) ++metrics.noticeable;
        metrics.largest = std::max(metrics.largest, difference.largest);
        for (std::size_t channel = 0; channel < 3; ++channel) {
            const int off = std::abs(int{difference.actual[channel]} - int{difference.expected[channel]});
            sum += static_cast<std::uint64_t>(off);
            squares += static_cast<std::uint64_t>(off * off);
        }
        keepWorst(metrics.worst, difference);
    }
    if (metrics.differing == 0) return metrics;
    const double channels = 3.0 * static_cast<double>(metrics.pixelCount);
    metrics.mean = static_cast<double>(sum) / channels;
    metrics.meanSquare = static_cast<double>(squares) / channels;
    metrics.ssim = structuralSimilarity(actual, expected, mask);
    return metrics;
}

double structuralSimilarity(const Image& actual, const Image& expected, const Image& mask) {
    requireOneSize(actual, expected);
    const Blocks columns(actual.width), rows(actual.height);
    const auto at = [&](int column, int row) { return static_cast<std::size_t>(row * columns.count + column); };
    std::vector<Sums> blocks(at(0, rows.count));
    double total = 0.0;
    std::size_t windows = 0;
    for (int channel = 0; channel < 3; ++channel) {
        for (int row = 0; row < rows.count; ++row)
            for (int column = 0; column < columns.count; ++column)
                blocks[at(column, row)] = blockSums(
                    actual, expected, mask, {column * columns.size, row * rows.size, columns.size, rows.size, channel});
        for (int row = 0; row < rows.windowCount(); ++row)
            for (int column = 0; column < columns.windowCount(); ++column) {
                Sums window;
                bool whole = true;
                for (int y = row; y < row + rows.perWindow; ++y)
                    for (int x = column; x < column + columns.perWindow; ++x) {
                        whole = whole && blocks[at(x, y)].count > 0;
                        window += blocks[at(x, y)];
                    }
                if (!whole) continue;
                total += similarity(window);
                ++windows;
            }
    }
    return windows == 0 ? 1.0 : total / static_cast<double>(windows);
}

}  // namespace render
