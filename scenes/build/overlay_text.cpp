// Formats the length of the scale bar, and places the ticks of the color bar.
#include "scenes/build/overlay_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scenes/model/to_float.h"

namespace scenes {
namespace {

/// The smallest step of 1, 2 or 5 times a power of ten that divides a range of values into at most five intervals.
double tickStep(double span) {
    const double unit = std::pow(10.0, std::floor(std::log10(span / 5.0)));
    for (const double factor : {1.0, 2.0, 5.0})
        if (span / (factor * unit) <= 5.0 + 1e-9) return factor * unit;  // the quotient is rounded
    return 10.0 * unit;
}

/// Exponent of the largest power of ten that is not above the given positive number.
int exponentOf(double number) {
    return static_cast<int>(std::floor(std::log10(number) + 1e-9));
}

/// The value of a tick with as many decimals as distinguish adjacent ticks, in exponent notation where these would be
/// too many.
std::string tickText(double value, double step) {
    constexpr int kMaxDecimals = 5;
    const int last = exponentOf(step);
    if (std::abs(last) <= kMaxDecimals) return fmt::format("{:.{}f}", value, std::max(0, -last));
    if (value == 0.0) return "0";
    return fmt::format("{:.{}e}", value, std::max(0, exponentOf(std::abs(value)) - last));
}

}  // namespace

std::string lengthText(double meters) {
    if (meters >= 1000.0) return fmt::format("{:.4g} km", meters / 1000.0);
    if (meters >= 1.0) return fmt::format("{:.4g} m", meters);
    if (meters >= 0.01) return fmt::format("{:.4g} cm", meters * 100.0);
    return fmt::format("{:.4g} mm", meters * 1000.0);
}

std::vector<render::Tick> ticksBetween(double low, double high) {
    const double step = tickStep(high - low);
    std::vector<render::Tick> ticks;
    // Ticks are integer multiples of the step rather than sums of steps, so that the third tick from 0 in steps of 0.1
    // is exactly 0.3.
    const double first = std::ceil(low / step - 1e-9);
    constexpr int kMaxTicks = 20;  // only for a range of values smaller than its own rounding error
    for (int k = 0; k < kMaxTicks && (first + k) * step <= high + 1e-9 * step; ++k) {
        const double value = (first + k) * step + 0.0;  // avoids "-0"
        ticks.push_back({toFloat((value - low) / (high - low)), tickText(value, step)});
    }
    return ticks;
}

}  // namespace scenes
