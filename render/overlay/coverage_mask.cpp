// Paints text and lines by blending the sRGB bytes of pixels rather than linear light: text then looks equally bold
// dark on light and light on dark, as in most programs. Blending uses integers only, so that it gives the same result
// on every machine.
#include "render/overlay/coverage_mask.h"

#include <algorithm>
#include <cmath>

namespace render {

namespace {

std::size_t indexOf(const CoverageMask& mask, int x, int y) {
    return static_cast<std::size_t>(y - mask.top) * static_cast<std::size_t>(mask.width) +
           static_cast<std::size_t>(x - mask.left);
}

/// Length of the overlap of the interval [low, high] with the pixel [pixel, pixel + 1].
double overlap(double low, double high, int pixel) {
    return std::max(0.0, std::min(high, pixel + 1.0) - std::max(low, static_cast<double>(pixel)));
}

/// Linear interpolation from a at t = 0 to b at t = 255, rounded to an integer.
int lerp(int a, int b, int t) {
    return (a * (255 - t) + b * t + 127) / 255;
}

/// For widening a mask: the offset of a neighbor from a covered pixel, and the share of the pixel's coverage that the
/// neighbor takes over, 0 to 255.
struct Neighbor {
    int dx = 0;
    int dy = 0;
    int share = 0;
};

/// All neighbors within a radius in pixels. Their share is 255 up to the radius and falls to 0 over one more pixel.
std::vector<Neighbor> disc(int radius) {
    std::vector<Neighbor> neighbors;
    for (int dy = -radius - 1; dy <= radius + 1; ++dy) {
        for (int dx = -radius - 1; dx <= radius + 1; ++dx) {
            const double inside = radius + 1.0 - std::sqrt(static_cast<double>(dx * dx + dy * dy));
            if (inside > 0.0) neighbors.push_back({dx, dy, static_cast<int>(255.0 * std::min(inside, 1.0))});
        }
    }
    return neighbors;
}

std::uint8_t srgbByte(float linear) {
    const double c = std::clamp(static_cast<double>(linear), 0.0, 1.0);
    const double encoded = c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1.0 / 2.4) - 0.055;
    return static_cast<std::uint8_t>(std::lround(255.0 * encoded));
}

}  // namespace

CoverageMask emptyMask(const Box& box) {
    CoverageMask mask;
    mask.left = static_cast<int>(std::floor(box.left));
    mask.top = static_cast<int>(std::floor(box.top));
    mask.width = std::max(0, static_cast<int>(std::ceil(box.right)) - mask.left);
    mask.height = std::max(0, static_cast<int>(std::ceil(box.bottom)) - mask.top);
    mask.coverage.assign(static_cast<std::size_t>(mask.width) * static_cast<std::size_t>(mask.height), 0);
    return mask;
}

void addCoverage(CoverageMask& mask, int x, int y, int coverage) {
    if (x < mask.left || y < mask.top || x >= mask.left + mask.width || y >= mask.top + mask.height) return;
    std::uint8_t& at = mask.coverage[indexOf(mask, x, y)];
    at = static_cast<std::uint8_t>(std::min(255, at + coverage));
}

void coverBox(CoverageMask& mask, const Box& box) {
    for (int y = static_cast<int>(std::floor(box.top)); y < box.bottom; ++y) {
        for (int x = static_cast<int>(std::floor(box.left)); x < box.right; ++x) {
            const double share = overlap(box.left, box.right, x) * overlap(box.top, box.bottom, y);
            addCoverage(mask, x, y, static_cast<int>(std::lround(255.0 * share)));
        }
    }
}

CoverageMask widened(const CoverageMask& mask, int radius) {
    const int margin = radius + 1;
    CoverageMask wide = emptyMask({static_cast<double>(mask.left - margin), static_cast<double>(mask.top - margin),
                                   static_cast<double>(mask.left + mask.width + margin),
                                   static_cast<double>(mask.top + mask.height + margin)});
    const std::vector<Neighbor> neighbors = disc(radius);
    for (int y = mask.top; y < mask.top + mask.height; ++y) {
        for (int x = mask.left; x < mask.left + mask.width; ++x) {
            const int coverage = mask.coverage[indexOf(mask, x, y)];
            if (coverage == 0) continue;
            for (const Neighbor& neighbor : neighbors) {
                std::uint8_t& at = wide.coverage[indexOf(wide, x + neighbor.dx, y + neighbor.dy)];
                at = std::max(at, static_cast<std::uint8_t>(lerp(0, coverage, neighbor.share)));
            }
        }
    }
    return wide;
}

Bytes srgbBytes(const glm::vec3& linear) {
    return {srgbByte(linear.x), srgbByte(linear.y), srgbByte(linear.z)};
}

void paint(Image& image, const CoverageMask& mask, const Bytes& color, int opacity) {
    const int x1 = std::min(mask.left + mask.width, image.width);
    const int y1 = std::min(mask.top + mask.height, image.height);
    for (int y = std::max(mask.top, 0); y < y1; ++y) {
        for (int x = std::max(mask.left, 0); x < x1; ++x) {
            const int share = lerp(0, mask.coverage[indexOf(mask, x, y)], opacity);
            if (share == 0) continue;
            std::uint8_t* pixel =
                image.rgb.data() +
                3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) + static_cast<std::size_t>(x));
            for (int channel = 0; channel < 3; ++channel)
                pixel[channel] = static_cast<std::uint8_t>(lerp(pixel[channel], color[channel], share));
        }
    }
}

}  // namespace render
