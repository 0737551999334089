// Pictures for the tests of comparison, made without the renderer, so that they do not change with it.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>

#include "render/picture/image.h"

namespace test_pictures {

inline std::uint8_t byteOf(double value) {
    return static_cast<std::uint8_t>(std::clamp(std::lround(value), 0L, 255L));
}

/// Shaded balls in front of a sky: edges, flat regions and gradients, dark and light.
inline render::Image balls(int width = 160, int height = 90) {
    render::Image image{width, height, {}};
    image.rgb.resize(image.byteCount());
    std::size_t k = 0;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            double red = 20 + 60.0 * y / height, green = 30 + 80.0 * y / height, blue = 60 + 120.0 * y / height;
            const double u = (x % 20 - 9.5) / 8.0, v = (y % 18 - 8.5) / 8.0;
            const double inside = 1.0 - u * u - v * v;
            if (inside > 0.0) {
                const double light = std::clamp(0.2 + 0.8 * (std::sqrt(inside) - 0.5 * u - 0.5 * v) / 1.5, 0.0, 1.0);
                red = 235 * light, green = (90 + x) * light, blue = 60 * light;
            }
            for (const double value : {red, green, blue}) image.rgb[k++] = byteOf(value);
        }
    return image;
}

inline render::Image flat(int width, int height, std::array<std::uint8_t, 3> color) {
    render::Image image{width, height, {}};
    for (int k = 0; k < width * height; ++k) image.rgb.insert(image.rgb.end(), color.begin(), color.end());
    return image;
}

/// The picture with every channel changed by up to `most`.
inline render::Image noisy(const render::Image& image, int most, unsigned seed = 5) {
    render::Image other = image;
    std::mt19937 random(seed);
    for (std::uint8_t& channel : other.rgb) {
        const int off = static_cast<int>(random() % static_cast<unsigned>(2 * most + 1)) - most;
        channel = byteOf(channel + off);
    }
    return other;
}

/// The picture shifted by one pixel to the right; the first column stays.
inline render::Image shifted(const render::Image& image) {
    render::Image other = image;
    const auto stride = static_cast<std::size_t>(3 * image.width);
    for (std::size_t row = 0; row < image.rgb.size(); row += stride)
        std::copy_n(image.rgb.begin() + static_cast<std::ptrdiff_t>(row), stride - 3,
                    other.rgb.begin() + static_cast<std::ptrdiff_t>(row) + 3);
    return other;
}

inline render::Image darker(const render::Image& image, double factor) {
    render::Image other = image;
    for (std::uint8_t& channel : other.rgb) channel = byteOf(factor * channel);
    return other;
}

/// The picture in grays of the same luma (BT.709).
inline render::Image gray(const render::Image& image) {
    render::Image other = image;
    for (std::size_t k = 0; k < image.rgb.size(); k += 3) {
        const std::uint8_t luma = byteOf(0.2126 * image.rgb[k] + 0.7152 * image.rgb[k + 1] + 0.0722 * image.rgb[k + 2]);
        std::fill_n(other.rgb.begin() + static_cast<std::ptrdiff_t>(k), 3, luma);
    }
    return other;
}

inline render::Image blank(const render::Image& image) {
    render::Image other = image;
    std::fill(other.rgb.begin(), other.rgb.end(), std::uint8_t{0});
    return other;
}

/// The picture with one channel of one pixel changed.
inline render::Image onePixel(const render::Image& image, int x, int y, int off) {
    render::Image other = image;
    std::uint8_t& channel = other.rgb[static_cast<std::size_t>(3 * (y * image.width + x) + 1)];
    channel = static_cast<std::uint8_t>(channel + (channel + off <= 255 ? off : -off));
    return other;
}

}  // namespace test_pictures
