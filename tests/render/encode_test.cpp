// sRGB encoding and dither against the formulas: of the background as the renderer draws it, and of encodeColors().
#include "tests/catch.h"

#include <array>
#include <cmath>

#include "render/cpu/metaballs/ray_layout.h"
#include "render/cpu/shading/shade.h"
#include "tests/render/pictures.h"

namespace {

/// By how much a byte is not what a color, dithered at a pixel, is rounded to, in steps of 1/255: half a step is the
/// rounding itself.
double errorOf(std::uint32_t byte, double linear, int x, int y) {
    return std::abs(pictures::encodedSteps(linear) + oracle::ditherThreshold(x, y) - 0.5 - byte);
}

/// Draws a background from `bottom` to `top` and returns the largest error of its bytes, in steps of 1/255.
double largestError(float bottom, float top) {
    constexpr int kHeight = 8192;
    render::View view;
    view.background = {glm::vec3(top), glm::vec3(bottom)};
    const render::Image image = pictures::drawn(view, {1, kHeight}, render::Quality::draft);
    double largest = 0.0;
    for (int y = 0; y < kHeight; ++y) {
        const double t = 1.0 - (y + 0.5) / kHeight;
        const double c = double(bottom) + (double(top) - double(bottom)) * t;
        largest = std::max(largest, errorOf(image.rgb[static_cast<std::size_t>(3 * y)], c, 0, y));
    }
    return largest;
}

/// The error of the k-th color of a tile, in steps of 1/255, beyond half a step for the rounding.
double errorOf(unsigned step, render::Rounding rounding, std::size_t k, double linear) {
    if (rounding == render::Rounding::nearest) return std::abs(step - pictures::encodedSteps(linear));
    return errorOf(step, linear, render::kZCurve[k] % 16, render::kZCurve[k] / 16);
}

/// The largest error of encodeColors(), in steps of 1/255; also checks that each channel is in its byte.
double largestEncodedError(float most, render::Rounding rounding) {
    constexpr int kTiles = 32;
    double largest = 0.0;
    for (int tile = 0; tile < kTiles; ++tile) {
        render::PointColors colors;
        const auto value = [&](std::size_t channel, std::size_t k) {
            const auto index =
                static_cast<float>(3 * (render::kTilePixels * static_cast<std::size_t>(tile) + k) + channel);
            return most * index / static_cast<float>(3 * kTiles * render::kTilePixels - 1);
        };
        for (std::size_t channel = 0; channel < 3; ++channel)
            for (std::size_t k = 0; k < render::kTilePixels; ++k) colors.rgb[channel][k] = value(channel, k);
        alignas(64) std::array<render::PixelColor, render::kTilePixels> encoded;
        render::encodeColors(colors, rounding, encoded.data());
        for (std::size_t channel = 0; channel < 3; ++channel)
            for (std::size_t k = 0; k < render::kTilePixels; ++k)
                largest = std::max(
                    largest, errorOf(encoded[k] >> (8 * channel) & 0xffU, rounding, k, double(value(channel, k))));
    }
    return largest;
}

// Half a step is the rounding itself. The polynomial is exact to 0.0025 of a step, and single precision to 0.001: 1e-7
// of c times a slope of up to 3300 steps near 0 and 110 steps at 1.
constexpr double kMostError = 0.5 + 0.0035;

}  // namespace

TEST_CASE("sRGB encoding rounds the exact value to the nearest step, or as the dither says") {
    CHECK(largestError(0.0F, 1.0F) < kMostError);
    CHECK(largestError(0.0F, 0.02F) < kMostError);  // the linear part, and where the curve begins
    for (const render::Rounding rounding : {render::Rounding::nearest, render::Rounding::dithered}) {
        CHECK(largestEncodedError(1.0F, rounding) < kMostError);
        CHECK(largestEncodedError(0.02F, rounding) < kMostError);
    }
}

TEST_CASE("Black is 0 and white is 255") {
    render::View view;
    view.background = {glm::vec3(1.0F), glm::vec3(1.0F)};
    CHECK(pictures::drawn(view, {3, 3}, render::Quality::normal).rgb == std::vector<std::uint8_t>(27, 255));
    view.background = {};
    CHECK(pictures::drawn(view, {3, 3}, render::Quality::final).rgb == std::vector<std::uint8_t>(27, 0));
}

TEST_CASE("A color that is a whole number of steps stays flat, and others are right on average") {
    const auto by = GENERATE(from_range(pictures::renderers()));
    CAPTURE(by);
    constexpr render::PictureSize kSize{40, 24};  // whole patterns of 8 x 8 pixels
    for (int step = 0; step <= 1020; step += 15) {
        const double encoded = step / 1020.0;  // quarters of a step of 1/255
        const double linear = encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
        render::View view;
        view.background = {glm::vec3(static_cast<float>(linear)), glm::vec3(static_cast<float>(linear))};
        const render::Image image = pictures::drawn(by, view, kSize, render::Quality::draft);
        double sum = 0.0;
        for (const std::uint8_t byte : image.rgb) sum += byte;
        INFO("step " << 0.25 * step);
        if (step % 4 == 0)
            CHECK(image.rgb == std::vector<std::uint8_t>(image.rgb.size(), static_cast<std::uint8_t>(step / 4)));
        // Each of the 64 thresholds stands for 1/64 of a step; a quarter of a step lies midway between two of them.
        CHECK(std::abs(sum / static_cast<double>(image.rgb.size()) - 0.25 * step) < 1.0 / 64.0);
    }
}
