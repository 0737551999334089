// Where things stand: the stamp in the upper left corner, the scale bar in the lower left, the color bar in the lower
// right. Every length follows from the height of the text. Each part is a mask that is painted twice: widened, as a
// halo, then as it is.
#include "render/overlay/draw_overlay.h"

#include <algorithm>
#include <cmath>

#include "render/overlay/coverage_mask.h"
#include "render/overlay/text.h"
#include "render/picture/camera_frame.h"

namespace render {

namespace {

constexpr double kCapital = 0.73;    // height of capitals and digits in DejaVu Sans, em
constexpr int kHaloOpacity = 150;    // chosen: text reads on any picture, and the halo does not shout
constexpr double kColorBarEms = 10;  // its height, at most half of the picture's

/// The picture, and what all parts of its overlay share.
struct Canvas {
    Image& image;
    const Overlay& overlay;
    double em = 0.0;
    int margin = 0;    ///< between the parts and the sides of the picture
    int hairline = 1;  ///< width of lines
};

Canvas canvasFor(Image& image, const Overlay& overlay) {
    const double em = overlayEm(image.width, image.height, overlay.size);
    return {image, overlay, em, static_cast<int>(std::lround(0.8 * em)),
            std::max(1, static_cast<int>(std::lround(em / 14.0)))};
}

double luminance(const glm::vec3& linear) {
    return dot(linear, glm::vec3(0.2126F, 0.7152F, 0.0722F));
}

void paintHalo(const Canvas& canvas, const CoverageMask& mask) {
    // 0.18 is as far from white as from black to the eye: middle gray.
    const glm::vec3 halo(luminance(canvas.overlay.ink) > 0.18 ? 0.0F : 1.0F);
    const int radius = std::max(1, static_cast<int>(std::lround(canvas.em / 12.0)));
    paint(canvas.image, widened(mask, radius), srgbBytes(halo), kHaloOpacity);
}

void paintInk(const Canvas& canvas, const CoverageMask& mask) {
    paint(canvas.image, mask, srgbBytes(canvas.overlay.ink));
}

Box around(const Box& a, const Box& b) {
    return {std::min(a.left, b.left), std::min(a.top, b.top), std::max(a.right, b.right), std::max(a.bottom, b.bottom)};
}

void drawStamp(const Canvas& canvas) {
    const int baseline = canvas.margin + static_cast<int>(std::lround(kCapital * canvas.em));
    const TextPlace place{static_cast<double>(canvas.margin), baseline, canvas.em};
    CoverageMask mask = emptyMask(textBox(canvas.overlay.stamp, place));
    coverText(mask, canvas.overlay.stamp, place);
    paintHalo(canvas, mask);
    paintInk(canvas, mask);
}

/// Pixels that a length takes at the distance of the camera's target.
double lengthOnPicture(const Canvas& canvas, const Camera& camera, double meters) {
    const CameraFrame frame = cameraFrame(camera, {canvas.image.width, canvas.image.height});
    const double depth = frame.perspective ? frame.toView(camera.target).z : 1.0;
    return meters / (frame.pixelWidth() * depth);
}

/// A line with a foot at each end, its text above the middle.
void drawScaleBar(const Canvas& canvas, const Camera& camera) {
    const ScaleBar& bar = *canvas.overlay.scaleBar;
    const double length = lengthOnPicture(canvas, camera, bar.length);
    if (!(length <= canvas.image.width - 2.0 * canvas.margin)) return;
    const double left = canvas.margin;
    const double bottom = canvas.image.height - canvas.margin;
    const double foot = std::round(0.4 * canvas.em);
    const double line = 2.0 * canvas.hairline;
    const double middle = left + 0.5 * (length - textWidth(bar.text, canvas.em));
    const TextPlace place{std::max(left, middle), static_cast<int>(bottom - foot - std::round(0.25 * canvas.em)),
                          canvas.em};
    CoverageMask mask = emptyMask(around(textBox(bar.text, place), {left, bottom - foot, left + length, bottom}));
    coverText(mask, bar.text, place);
    // No pixel is covered twice, so that the shares of those at the right end add up to the length.
    coverBox(mask, {left, bottom - line, left + length, bottom});
    const double width = std::min(line, 0.5 * length);
    coverBox(mask, {left, bottom - foot, left + width, bottom - line});
    coverBox(mask, {left + length - width, bottom - foot, left + length, bottom - line});
    paintHalo(canvas, mask);
    paintInk(canvas, mask);
}

glm::vec3 colorAt(const std::vector<glm::vec3>& colors, double place) {
    const double scaled = place * static_cast<double>(colors.size() - 1);
    const auto below = static_cast<std::size_t>(scaled);
    const auto above = std::min(below + 1, colors.size() - 1);
    return mix(colors[below], colors[above], static_cast<float>(scaled - static_cast<double>(below)));
}

/// Each row of the bar in the color of its middle.
void paintColors(const Canvas& canvas, const Box& bar) {
    const auto rows = static_cast<int>(bar.bottom - bar.top);
    for (int row = 0; row < rows; ++row) {
        const Box line{bar.left, bar.top + row, bar.right, bar.top + row + 1.0};
        CoverageMask mask = emptyMask(line);
        coverBox(mask, line);
        const double place = 1.0 - (row + 0.5) / rows;
        paint(canvas.image, mask, srgbBytes(colorAt(canvas.overlay.colorBar->colors, place)));
    }
}

/// Whole pixels, the widest tick's text between the bar and the margin.
Box colorBarBox(const Canvas& canvas) {
    double widest = 0.0;
    for (const Tick& tick : canvas.overlay.colorBar->ticks) widest = std::max(widest, textWidth(tick.text, canvas.em));
    const double right = std::floor(canvas.image.width - canvas.margin - widest - 0.6 * canvas.em);
    const double height = std::round(std::min(kColorBarEms * canvas.em, 0.5 * canvas.image.height));
    const double bottom = canvas.image.height - canvas.margin - std::round(0.4 * canvas.em);
    return {right - std::round(canvas.em), bottom - height, right, bottom};
}

/// Frame, ticks with their texts to the right, title above, all the way to the right margin.
CoverageMask colorBarLines(const Canvas& canvas, const Box& bar) {
    const ColorBar& colorBar = *canvas.overlay.colorBar;
    const double w = canvas.hairline;
    const int lift = static_cast<int>(std::lround(0.5 * kCapital * canvas.em));  // from the middle of digits down
    const double end = canvas.image.width - canvas.margin;
    const double titleLeft = std::min(bar.left, end - textWidth(colorBar.title, canvas.em));
    const TextPlace title{titleLeft, static_cast<int>(bar.top - std::round(canvas.em)), canvas.em};
    const Box all{bar.left - w, bar.top - canvas.em, end + canvas.em, bar.bottom + canvas.em};
    CoverageMask mask = emptyMask(around(all, textBox(colorBar.title, title)));
    coverText(mask, colorBar.title, title);
    coverBox(mask, {bar.left - w, bar.top - w, bar.right + w, bar.top});
    coverBox(mask, {bar.left - w, bar.bottom, bar.right + w, bar.bottom + w});
    coverBox(mask, {bar.left - w, bar.top, bar.left, bar.bottom});
    coverBox(mask, {bar.right, bar.top, bar.right + w, bar.bottom});
    for (const Tick& tick : colorBar.ticks) {
        const double row =
            std::clamp(std::round(bar.bottom - tick.place * (bar.bottom - bar.top) - 0.5 * w), bar.top, bar.bottom - w);
        coverBox(mask, {bar.right + w, row, bar.right + std::round(0.3 * canvas.em), row + w});
        coverText(mask, tick.text, {bar.right + 0.6 * canvas.em, static_cast<int>(row) + lift, canvas.em});
    }
    return mask;
}

void drawColorBar(const Canvas& canvas) {
    const Box bar = colorBarBox(canvas);
    const CoverageMask lines = colorBarLines(canvas, bar);
    paintHalo(canvas, lines);
    paintColors(canvas, bar);
    paintInk(canvas, lines);
}

}  // namespace

double overlayEm(int width, int height, double size) {
    return std::max(11.0, 0.03 * std::min(width, height)) * size;
}

void drawOverlay(Image& image, const Overlay& overlay, const Camera& camera) {
    if (overlay.stamp.empty() && !overlay.scaleBar && !overlay.colorBar) return;
    const Canvas canvas = canvasFor(image, overlay);
    if (!overlay.stamp.empty()) drawStamp(canvas);
    if (overlay.scaleBar) drawScaleBar(canvas, camera);
    if (overlay.colorBar) drawColorBar(canvas);
}

}  // namespace render
