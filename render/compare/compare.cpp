// Compares two pictures against limits and names every limit that is exceeded, not only the first; draws images of
// their differences.
#include "render/compare/compare.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <stdexcept>

namespace render {
namespace {

std::string largestReason(const PictureMetrics& metrics, int limit) {
    const PixelDifference& worst = metrics.worst.front();
    return fmt::format("a channel is off by {} at ({}, {}), allowed are {}", metrics.largest, worst.x, worst.y, limit);
}

void checkLimits(Comparison& comparison, const CompareLimits& limits) {
    const PictureMetrics& metrics = comparison.metrics;
    const auto exceeded = [&](CompareRule rule, std::string reason) {
        if (comparison.passed()) comparison.rule = rule;
        comparison.reasons.push_back(std::move(reason));
    };
    comparison.rule = CompareRule::withinLimits;
    if (metrics.largest > limits.largest) exceeded(CompareRule::largest, largestReason(metrics, limits.largest));
    if (metrics.share() > limits.share)
        exceeded(CompareRule::share, fmt::format("{:.3f} % of pixels are off by more than {}, allowed are {:.3g} %",
                                                 100.0 * metrics.share(), limits.threshold, 100.0 * limits.share));
    if (metrics.mean > limits.mean)
        exceeded(CompareRule::mean,
                 fmt::format("the mean difference is {:.4f}, allowed is {:.3g}", metrics.mean, limits.mean));
    if (metrics.ssim < limits.ssim)
        exceeded(CompareRule::ssim, fmt::format("the structural similarity is {:.5f}, at least {:.3g} is wanted",
                                                metrics.ssim, limits.ssim));
}

using Color = glm::dvec3;

/// The color scale of heatMap(), 8-bit sRGB. Chosen: its lightness rises throughout, so that it can be read in gray as
/// well.
constexpr std::array<Color, 6> kStops = {
    {{40, 40, 140}, {120, 30, 170}, {205, 50, 110}, {245, 120, 40}, {255, 210, 60}, {255, 255, 255}}};

/// @param heat  from 0 to 1
Color colorOf(double heat) {
    const double position = heat * (kStops.size() - 1);
    const std::size_t below = std::min(static_cast<std::size_t>(position), kStops.size() - 2);
    const double part = position - static_cast<double>(below);
    return (1.0 - part) * kStops[below] + part * kStops[below + 1];
}

int differenceOf(const Image& actual, const Image& expected, std::size_t k) {
    return std::abs(int{actual.rgb[k]} - int{expected.rgb[k]});
}

}  // namespace

CompareLimits limitsOf(std::string_view profile) {
    if (profile == "strict") return {};
    // Limits of the profile "vendor". Chosen: reciprocals and square roots of OpenGL drivers differ by less, a missing
    // particle by more. The mean is that of a picture in which one channel in twenty differs by 1; the structural
    // similarity is that of a picture on a dark background that just keeps all other limits.
    if (profile == "vendor") return {.threshold = 3, .share = 0.005, .largest = 16, .mean = 0.05, .ssim = 0.98};
    // Limits of the profile "renderer". Chosen: the two renderers take other samples of a pixel and round differently
    // at outlines and edges of shadows; a wrong term of the shading shows in more pixels, a lost particle in a larger
    // difference.
    if (profile == "renderer") return {.threshold = 6, .share = 0.01, .largest = 64, .mean = 0.4, .ssim = 0.98};
    // Limits of the profile "loose". Chosen: a picture with other antialiasing or slightly different light passes, the
    // next frame of the animation does not: even in a fountain at 640x360 it changes some channel by more than 100.
    if (profile == "loose") return {.threshold = 16, .share = 0.01, .largest = 64, .mean = 3.0, .ssim = 0.9};
    throw std::invalid_argument(
        fmt::format("there is no profile \"{}\"; choose one of: strict, vendor, renderer, loose", profile));
}

const char* nameOf(CompareRule rule) {
    constexpr const char* kNames[] = {"identical", "size", "largest", "share", "mean", "ssim", "within-limits"};
    return kNames[static_cast<std::size_t>(rule)];
}

Comparison compare(const Image& actual, const Image& expected, const CompareLimits& limits, const Image& mask) {
    Comparison comparison;
    if (actual.width != expected.width || actual.height != expected.height) {
        comparison.rule = CompareRule::size;
        comparison.reasons.push_back(fmt::format("the picture is {}x{}, expected is {}x{}", actual.width, actual.height,
                                                 expected.width, expected.height));
        return comparison;
    }
    comparison.metrics = measure(actual, expected, mask, limits.threshold);
    if (comparison.metrics.differing > 0) checkLimits(comparison, limits);
    return comparison;
}

Image differenceImage(const Image& actual, const Image& expected) {
    Image image = expected;
    for (std::size_t k = 0; k < image.rgb.size(); ++k)
        image.rgb[k] = static_cast<std::uint8_t>(std::min(255, 16 * differenceOf(actual, expected, k)));
    return image;
}

Image heatMap(const Image& actual, const Image& expected) {
    Image image = expected;
    for (std::size_t k = 0; k < image.rgb.size(); k += 3) {
        const int largest = std::max({differenceOf(actual, expected, k), differenceOf(actual, expected, k + 1),
                                      differenceOf(actual, expected, k + 2)});
        const double gray = (expected.rgb[k] + expected.rgb[k + 1] + expected.rgb[k + 2]) / (3.0 * 5.0);
        const Color color = largest == 0 ? Color(gray) : colorOf(std::log2(largest) / std::log2(255.0));
        for (int channel = 0; channel < 3; ++channel)
            image.rgb[k + static_cast<std::size_t>(channel)] = static_cast<std::uint8_t>(std::lround(color[channel]));
    }
    return image;
}

}  // namespace render
