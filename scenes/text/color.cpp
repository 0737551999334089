// The sRGB curve, hexadecimal colors and color ramps.
#include "scenes/text/color.h"

#include <algorithm>
#include <cmath>

namespace scenes {
namespace {

int digitOf(char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    if (c >= 'A' && c <= 'F') return c - 'A' + 10;
    return -1;
}

}  // namespace

double linearFromSrgb(double component) {
    return component <= 0.04045 ? component / 12.92 : std::pow((component + 0.055) / 1.055, 2.4);
}

std::optional<engine::Vec3> colorFromHex(std::string_view text) {
    if (text.size() != 7 || text[0] != '#') return std::nullopt;
    engine::Vec3 color = engine::Vec3::Zero();
    for (int channel = 0; channel < 3; ++channel) {
        const auto at = static_cast<std::size_t>(1 + 2 * channel);
        const int high = digitOf(text[at]);
        const int low = digitOf(text[at + 1]);
        if (high < 0 || low < 0) return std::nullopt;
        color[channel] = linearFromSrgb((16 * high + low) / 255.0);
    }
    return color;
}

engine::Vec3 rampColor(const std::vector<engine::Vec3>& colors, double place) {
    // The comparison is written so that a place that is no number takes the first color.
    if (!(place > 0.0) || colors.size() == 1) return colors.front();
    if (place >= 1.0) return colors.back();
    const double scaled = place * static_cast<double>(colors.size() - 1);
    const auto below = std::min(static_cast<std::size_t>(scaled), colors.size() - 2);
    const double share = scaled - static_cast<double>(below);
    return (1.0 - share) * colors[below] + share * colors[below + 1];
}

}  // namespace scenes
