// Per pixel, no state.
#include "render/compare/difference_image.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

namespace render {
namespace {

using Color = std::array<double, 3>;

/// Chosen to rise in lightness from one stop to the next, so that it can be read without colors as well.
constexpr std::array<Color, 6> kStops = {
    {{40, 40, 140}, {120, 30, 170}, {205, 50, 110}, {245, 120, 40}, {255, 210, 60}, {255, 255, 255}}};

/// Shape: heat in 0 ... 1.
Color colorOf(double heat) {
    const double position = heat * (kStops.size() - 1);
    const std::size_t below = std::min(static_cast<std::size_t>(position), kStops.size() - 2);
    const double part = position - static_cast<double>(below);
    Color color;
    for (std::size_t channel = 0; channel < 3; ++channel)
        color[channel] = (1.0 - part) * kStops[below][channel] + part * kStops[below + 1][channel];
    return color;
}

int offBy(const Image& actual, const Image& expected, std::size_t k) {
    return std::abs(int{actual.rgb[k]} - int{expected.rgb[k]});
}

}  // namespace

Image differenceImage(const Image& actual, const Image& expected) {
    Image image = expected;
    for (std::size_t k = 0; k < image.rgb.size(); ++k)
        image.rgb[k] = static_cast<std::uint8_t>(std::min(255, 16 * offBy(actual, expected, k)));
    return image;
}

Image heatMap(const Image& actual, const Image& expected) {
    Image image = expected;
    for (std::size_t k = 0; k < image.rgb.size(); k += 3) {
        const int off =
            std::max({offBy(actual, expected, k), offBy(actual, expected, k + 1), offBy(actual, expected, k + 2)});
        const double gray = (expected.rgb[k] + expected.rgb[k + 1] + expected.rgb[k + 2]) / (3.0 * 5.0);
        const Color color = off == 0 ? Color{gray, gray, gray} : colorOf(std::log2(off) / std::log2(255.0));
        for (std::size_t channel = 0; channel < 3; ++channel)
            image.rgb[k + channel] = static_cast<std::uint8_t>(std::lround(color[channel]));
    }
    return image;
}

}  // namespace render
