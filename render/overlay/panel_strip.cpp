// Copies pictures into a strip and draws a text below each, with the font and the size that the text of an overlay has
// on one of the pictures.
#include "render/overlay/panel_strip.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "render/overlay/coverage_mask.h"
#include "render/overlay/draw_overlay.h"
#include "render/overlay/text.h"

namespace render {

namespace {

constexpr Bytes kInk{26, 26, 26};  // chosen: nearly black

void requireOneSize(const std::vector<Panel>& panels) {
    if (panels.empty()) throw std::logic_error("render: a strip needs at least one panel");
    for (const Panel& panel : panels) {
        const Image& first = panels.front().image;
        if (panel.image.width == first.width && panel.image.height == first.height) continue;
        throw std::logic_error(fmt::format("render: panels of {} x {} and {} x {} pixels in one strip", first.width,
                                           first.height, panel.image.width, panel.image.height));
    }
}

void copyInto(const Image& panel, int left, Image& strip) {
    const auto rowBytes = static_cast<std::ptrdiff_t>(3) * panel.width;
    for (int y = 0; y < panel.height; ++y)
        std::copy_n(panel.rgb.begin() + y * rowBytes, rowBytes,
                    strip.rgb.begin() + std::ptrdiff_t{3} * (std::ptrdiff_t{y} * strip.width + left));
}

/// Draws the text below a panel with the largest em, or with a smaller one if the text would be wider than the panel.
void drawLabel(const std::string& text, double center, int baseline, double largestEm, int width, Image& strip) {
    const double em = largestEm * std::min(1.0, width / textWidth(text, largestEm));
    const TextPosition at{std::round(center - 0.5 * textWidth(text, em)), baseline, em};
    CoverageMask mask = emptyMask(textBox(text, at));
    coverText(mask, text, at);
    paint(strip, mask, kInk);
}

}  // namespace

Image joinPanels(const std::vector<Panel>& panels) {
    requireOneSize(panels);
    const int width = panels.front().image.width;
    const int height = panels.front().image.height;
    const auto count = static_cast<int>(panels.size());
    const double em = overlayEm(width, height, 1.0);
    const int gap = std::max(2, static_cast<int>(std::lround(em / 5.0)));
    Image strip{count * width + (count - 1) * gap, height + static_cast<int>(std::lround(1.9 * em)), {}};
    strip.rgb.assign(strip.byteCount(), 255);
    for (int k = 0; k < count; ++k) {
        const Panel& panel = panels[static_cast<std::size_t>(k)];
        const int left = k * (width + gap);
        copyInto(panel.image, left, strip);
        drawLabel(panel.text, left + 0.5 * width, height + static_cast<int>(std::lround(1.3 * em)), em, width, strip);
    }
    return strip;
}

}  // namespace render
