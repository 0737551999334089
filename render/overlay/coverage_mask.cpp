// Bytes are mixed as they are, not in linear light: text keeps the same weight dark on light and light on dark, as in
// any other program. Whole numbers only, so that the result is the same everywhere.
#include "render/overlay/coverage_mask.h"

#include <algorithm>
#include <cmath>

namespace render {

namespace {

std::size_t indexOf(const Stencil& stencil, int x, int y) {
    return static_cast<std::size_t>(y - stencil.top) * static_cast<std::size_t>(stencil.width) +
           static_cast<std::size_t>(x - stencil.left);
}

/// Length of what the interval from low to high has of the pixel that begins at a whole number.
double overlap(double low, double high, int pixel) {
    return std::max(0.0, std::min(high, pixel + 1.0) - std::max(low, static_cast<double>(pixel)));
}

int mixed(int below, int above, int share) {
    return (below * (255 - share) + above * share + 127) / 255;
}

/// A pixel beside another, and how much of the other's coverage it takes, 0 to 255.
struct Neighbor {
    int dx = 0;
    int dy = 0;
    int share = 0;
};

/// Everything within the radius, and less over the last pixel.
std::vector<Neighbor> discOf(int radius) {
    std::vector<Neighbor> disc;
    for (int dy = -radius - 1; dy <= radius + 1; ++dy) {
        for (int dx = -radius - 1; dx <= radius + 1; ++dx) {
            const double inside = radius + 1.0 - std::sqrt(static_cast<double>(dx * dx + dy * dy));
            if (inside > 0.0) disc.push_back({dx, dy, static_cast<int>(255.0 * std::min(inside, 1.0))});
        }
    }
    return disc;
}

std::uint8_t srgbByte(float linear) {
    const double c = std::clamp(static_cast<double>(linear), 0.0, 1.0);
    const double encoded = c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1.0 / 2.4) - 0.055;
    return static_cast<std::uint8_t>(std::lround(255.0 * encoded));
}

}  // namespace

Stencil stencilAround(const Box& box) {
    Stencil stencil;
    stencil.left = static_cast<int>(std::floor(box.left));
    stencil.top = static_cast<int>(std::floor(box.top));
    stencil.width = std::max(0, static_cast<int>(std::ceil(box.right)) - stencil.left);
    stencil.height = std::max(0, static_cast<int>(std::ceil(box.bottom)) - stencil.top);
    stencil.coverage.assign(static_cast<std::size_t>(stencil.width) * static_cast<std::size_t>(stencil.height), 0);
    return stencil;
}

void coverBox(Stencil& stencil, const Box& box) {
    const int x0 = std::max(stencil.left, static_cast<int>(std::floor(box.left)));
    const int x1 = std::min(stencil.left + stencil.width, static_cast<int>(std::ceil(box.right)));
    const int y0 = std::max(stencil.top, static_cast<int>(std::floor(box.top)));
    const int y1 = std::min(stencil.top + stencil.height, static_cast<int>(std::ceil(box.bottom)));
    for (int y = y0; y < y1; ++y) {
        for (int x = x0; x < x1; ++x) {
            const double share = overlap(box.left, box.right, x) * overlap(box.top, box.bottom, y);
            std::uint8_t& at = stencil.coverage[indexOf(stencil, x, y)];
            at = static_cast<std::uint8_t>(std::min(255L, at + std::lround(255.0 * share)));
        }
    }
}

Stencil widened(const Stencil& stencil, int radius) {
    const int margin = radius + 1;
    Stencil wide = stencilAround({static_cast<double>(stencil.left - margin), static_cast<double>(stencil.top - margin),
                                  static_cast<double>(stencil.left + stencil.width + margin),
                                  static_cast<double>(stencil.top + stencil.height + margin)});
    const std::vector<Neighbor> disc = discOf(radius);
    for (int y = stencil.top; y < stencil.top + stencil.height; ++y) {
        for (int x = stencil.left; x < stencil.left + stencil.width; ++x) {
            const int coverage = stencil.coverage[indexOf(stencil, x, y)];
            if (coverage == 0) continue;
            for (const Neighbor& next : disc) {
                std::uint8_t& at = wide.coverage[indexOf(wide, x + next.dx, y + next.dy)];
                at = std::max(at, static_cast<std::uint8_t>(mixed(0, coverage, next.share)));
            }
        }
    }
    return wide;
}

Bytes srgbBytes(const glm::vec3& linear) {
    return {srgbByte(linear.x), srgbByte(linear.y), srgbByte(linear.z)};
}

void paint(Image& image, const Stencil& stencil, const Bytes& color, int opacity) {
    const int x1 = std::min(stencil.left + stencil.width, image.width);
    const int y1 = std::min(stencil.top + stencil.height, image.height);
    for (int y = std::max(stencil.top, 0); y < y1; ++y) {
        for (int x = std::max(stencil.left, 0); x < x1; ++x) {
            const int share = mixed(0, stencil.coverage[indexOf(stencil, x, y)], opacity);
            if (share == 0) continue;
            std::uint8_t* pixel =
                image.rgb.data() +
                3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) + static_cast<std::size_t>(x));
            for (int channel = 0; channel < 3; ++channel)
                pixel[channel] = static_cast<std::uint8_t>(mixed(pixel[channel], color[channel], share));
        }
    }
}

}  // namespace render
