// Numbers to texts.
#include "scenes/view/overlay_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scenes/view/single.h"

namespace scenes {
namespace {

/// The smallest step of 1, 2 or 5 times a power of ten that leaves at most five intervals.
double stepOf(double span) {
    const double unit = std::pow(10.0, std::floor(std::log10(span / 5.0)));
    for (const double factor : {1.0, 2.0, 5.0})
        if (span / (factor * unit) <= 5.0 + 1e-9) return factor * unit;  // the quotient of two decimals is rounded
    return 10.0 * unit;
}

/// A power of ten at or below a positive number.
int magnitudeOf(double number) {
    return static_cast<int>(std::floor(std::log10(number) + 1e-9));
}

/// Digits down to those that tell neighbors apart, as a power of ten where they would be too many.
std::string tickText(double value, double step) {
    constexpr int kMostPlaces = 5;
    const int last = magnitudeOf(step);
    if (std::abs(last) <= kMostPlaces) return fmt::format("{:.{}f}", value, std::max(0, -last));
    if (value == 0.0) return "0";
    return fmt::format("{:.{}e}", value, std::max(0, magnitudeOf(std::abs(value)) - last));
}

render::ColorBar colorBarOf(const Scene& scene) {
    render::ColorBar bar;
    for (const engine::Vec3& color : scene.look.ramp) bar.colors.push_back(single(color));
    bar.title = fmt::format("{} ({})", scene.overlay.colorLabel, scene.look.colorBy == ColorBy::age ? "s" : "m/s");
    bar.ticks = ticksBetween(scene.look.rampLow, scene.look.rampHigh);
    return bar;
}

}  // namespace

render::Overlay overlayOf(const Scene& scene, double time) {
    const Overlay& asked = scene.overlay;
    render::Overlay overlay;
    if (asked.time) overlay.stamp = timeText(scene, time);
    if (asked.scaleBar > 0.0) overlay.scaleBar = render::ScaleBar{single(asked.scaleBar), lengthText(asked.scaleBar)};
    if (asked.colorBar) overlay.colorBar = colorBarOf(scene);
    overlay.ink = single(asked.ink);
    overlay.size = single(asked.size);
    return overlay;
}

std::string timeText(const Scene& scene, double time) {
    // Frames are 1/fps apart: 0.01 s tells them apart up to 100 a second.
    return fmt::format("t = {:.{}f} s", time, scene.fps > 100 ? 3 : 2);
}

std::string lengthText(double meters) {
    if (meters >= 1000.0) return fmt::format("{:.4g} km", meters / 1000.0);
    if (meters >= 1.0) return fmt::format("{:.4g} m", meters);
    if (meters >= 0.01) return fmt::format("{:.4g} cm", meters * 100.0);
    return fmt::format("{:.4g} mm", meters * 1000.0);
}

std::vector<render::Tick> ticksBetween(double low, double high) {
    const double step = stepOf(high - low);
    std::vector<render::Tick> ticks;
    // Whole multiples of the step, so that the third tick from 0 by 0.1 is 0.3 and no number near it.
    const double first = std::ceil(low / step - 1e-9);
    constexpr int kMost = 20;  // more than any step leads to, unless the range is below its own rounding
    for (int k = 0; k < kMost && (first + k) * step <= high + 1e-9 * step; ++k) {
        const double value = (first + k) * step + 0.0;  // no "-0"
        ticks.push_back({single((value - low) / (high - low)), tickText(value, step)});
    }
    return ticks;
}

}  // namespace scenes
