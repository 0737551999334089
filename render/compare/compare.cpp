// Limits in a row; every one that is broken is named.
#include "render/compare/compare.h"

#include <fmt/format.h>

#include <stdexcept>

namespace render {
namespace {

std::string largestReason(const PictureMetrics& metrics, int limit) {
    const PixelDifference& worst = metrics.worst.front();
    return fmt::format("a channel is off by {} at ({}, {}), allowed are {}", metrics.largest, worst.x, worst.y, limit);
}

void judge(Comparison& comparison, const CompareLimits& limits) {
    const PictureMetrics& metrics = comparison.metrics;
    const auto breaks = [&](CompareRule rule, std::string reason) {
        if (comparison.passed()) comparison.rule = rule;
        comparison.reasons.push_back(std::move(reason));
    };
    comparison.rule = CompareRule::withinLimits;
    if (metrics.largest > limits.largest) breaks(CompareRule::largest, largestReason(metrics, limits.largest));
    if (metrics.share() > limits.share)
        breaks(CompareRule::share, fmt::format("{:.3f} % of pixels are off by more than {}, allowed are {:.3g} %",
                                               100.0 * metrics.share(), limits.threshold, 100.0 * limits.share));
    if (metrics.mean > limits.mean)
        breaks(CompareRule::mean,
               fmt::format("the mean difference is {:.4f}, allowed is {:.3g}", metrics.mean, limits.mean));
    if (metrics.ssim < limits.ssim)
        breaks(CompareRule::ssim, fmt::format("the structural similarity is {:.5f}, at least {:.3g} is wanted",
                                              metrics.ssim, limits.ssim));
}

}  // namespace

CompareLimits limitsOf(std::string_view profile) {
    if (profile == "strict") return {};
    // Chosen: reciprocals and roots of drivers differ by less, a missing particle does not. The mean is a picture in
    // which one channel in twenty is off by one, the similarity that of the other limits used up on a dark background.
    if (profile == "vendor") return {.threshold = 3, .share = 0.005, .largest = 16, .mean = 0.05, .ssim = 0.98};
    // Chosen: other edges and a little less light pass, a frame later does not: that changes a channel by more than 100
    // even of a fountain at 640x360.
    if (profile == "loose") return {.threshold = 16, .share = 0.01, .largest = 64, .mean = 3.0, .ssim = 0.9};
    throw std::invalid_argument(fmt::format("there is no profile \"{}\"; choose one of: {}", profile, kProfileNames));
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
    if (comparison.metrics.differing > 0) judge(comparison, limits);
    return comparison;
}

}  // namespace render
