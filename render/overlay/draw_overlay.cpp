// Draws the time stamp in the top left corner of the picture, the scale bar in the bottom left, the color bar in the
// bottom right. Every length is a multiple of the text's em. Text and lines are drawn into a coverage mask, which is
// painted twice: widened, as a halo that sets the text off from the picture, then as it is.
#include "render/overlay/draw_overlay.h"

#include <algorithm>
#include <cmath>

#include "render/overlay/coverage_mask.h"
#include "render/overlay/text.h"
#include "render/picture/camera_frame.h"

namespace render {

namespace {

constexpr double kCapitalHeight = 0.73;  // height of capitals and digits in DejaVu Sans, em
constexpr int kHaloOpacity =
    150;  // opacity of the halo, of 255; chosen: text is legible on any picture, and the halo does not dominate
constexpr double kColorBarHeight = 10.0;  // height of the color bar, em; at most half the height of the picture

/// The picture under an overlay, and the lengths in pixels that time stamp, scale bar and color bar share.
struct Canvas {
    Image& image;
    const Overlay& overlay;
    double em = 0.0;
    int margin = 0;    ///< distance of the overlay from the sides of the picture
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
    // A luminance of 0.18 is middle gray, which looks halfway between black and white.
    const glm::vec3 halo(luminance(canvas.overlay.ink) > 0.18 ? 0.0F : 1.0F);
    const int radius = std::max(1, static_cast<int>(std::lround(canvas.em / 12.0)));
    paint(canvas.image, widened(mask, radius), srgbBytes(halo), kHaloOpacity);
}

void paintInk(const Canvas& canvas, const CoverageMask& mask) {
    paint(canvas.image, mask, srgbBytes(canvas.overlay.ink));
}

Box enclosing(const Box& a, const Box& b) {
    return {std::min(a.left, b.left), std::min(a.top, b.top), std::max(a.right, b.right), std::max(a.bottom, b.bottom)};
}

void drawStamp(const Canvas& canvas) {
    const int baseline = canvas.margin + static_cast<int>(std::lround(kCapitalHeight * canvas.em));
    const TextPosition position{static_cast<double>(canvas.margin), baseline, canvas.em};
    CoverageMask mask = emptyMask(textBox(canvas.overlay.stamp, position));
    coverText(mask, canvas.overlay.stamp, position);
    paintHalo(canvas, mask);
    paintInk(canvas, mask);
}

/// Length in pixels that a length in meters has in the picture at the distance of the camera's target.
double lengthOnPicture(const Canvas& canvas, const Camera& camera, double meters) {
    const CameraFrame frame = cameraFrame(camera, {canvas.image.width, canvas.image.height});
    const double depth = frame.perspective ? frame.toView(camera.target).z : 1.0;
    return meters / (frame.pixelWidth() * depth);
}

/// Draws the scale bar: a horizontal line with a vertical tick at each end, and its text centered above.
void drawScaleBar(const Canvas& canvas, const Camera& camera) {
    const ScaleBar& bar = *canvas.overlay.scaleBar;
    const double length = lengthOnPicture(canvas, camera, bar.length);
    if (!(length <= canvas.image.width - 2.0 * canvas.margin)) return;
    const double left = canvas.margin;
    const double bottom = canvas.image.height - canvas.margin;
    const double tick = std::round(0.4 * canvas.em);
    const double line = 2.0 * canvas.hairline;
    const double middle = left + 0.5 * (length - textWidth(bar.text, canvas.em));
    const TextPosition position{std::max(left, middle), static_cast<int>(bottom - tick - std::round(0.25 * canvas.em)),
                                canvas.em};
    CoverageMask mask = emptyMask(enclosing(textBox(bar.text, position), {left, bottom - tick, left + length, bottom}));
    coverText(mask, bar.text, position);
    // The rectangles of line and ticks do not overlap, so that the partly covered pixels at the right end add up to the
    // exact length.
    coverBox(mask, {left, bottom - line, left + length, bottom});
    const double width = std::min(line, 0.5 * length);
    coverBox(mask, {left, bottom - tick, left + width, bottom - line});
    coverBox(mask, {left + length - width, bottom - tick, left + length, bottom - line});
    paintHalo(canvas, mask);
    paintInk(canvas, mask);
}

/// Interpolates between a color bar's evenly spaced colors.
/// @param position  0 for the first color, 1 for the last
glm::vec3 colorAt(const std::vector<glm::vec3>& colors, double position) {
    const double scaled = position * static_cast<double>(colors.size() - 1);
    const auto below = static_cast<std::size_t>(scaled);
    const auto above = std::min(below + 1, colors.size() - 1);
    return mix(colors[below], colors[above], static_cast<float>(scaled - static_cast<double>(below)));
}

/// Paints each row of pixels of the color bar with the color at its center.
void paintColors(const Canvas& canvas, const Box& bar) {
    const auto rows = static_cast<int>(bar.bottom - bar.top);
    for (int row = 0; row < rows; ++row) {
        const Box line{bar.left, bar.top + row, bar.right, bar.top + row + 1.0};
        CoverageMask mask = emptyMask(line);
        coverBox(mask, line);
        const double position = 1.0 - (row + 0.5) / rows;
        paint(canvas.image, mask, srgbBytes(colorAt(canvas.overlay.colorBar->colors, position)));
    }
}

/// Where the color bar is, in whole pixels, with room for the widest text of a tick between the bar and the picture's
/// margin.
Box colorBarBox(const Canvas& canvas) {
    double widest = 0.0;
    for (const Tick& tick : canvas.overlay.colorBar->ticks) widest = std::max(widest, textWidth(tick.text, canvas.em));
    const double right = std::floor(canvas.image.width - canvas.margin - widest - 0.6 * canvas.em);
    const double height = std::round(std::min(kColorBarHeight * canvas.em, 0.5 * canvas.image.height));
    const double bottom = canvas.image.height - canvas.margin - std::round(0.4 * canvas.em);
    return {right - std::round(canvas.em), bottom - height, right, bottom};
}

/// Text and lines of the color bar: its frame, the ticks with their texts on the right, and the title above. A title
/// that is wider than bar and texts ends at the picture's margin.
CoverageMask colorBarLines(const Canvas& canvas, const Box& bar) {
    const ColorBar& colorBar = *canvas.overlay.colorBar;
    const double w = canvas.hairline;
    const auto halfCapital = static_cast<int>(std::lround(0.5 * kCapitalHeight * canvas.em));
    const double end = canvas.image.width - canvas.margin;
    const double titleLeft = std::min(bar.left, end - textWidth(colorBar.title, canvas.em));
    const TextPosition title{titleLeft, static_cast<int>(bar.top - std::round(canvas.em)), canvas.em};
    const Box all{bar.left - w, bar.top - canvas.em, end + canvas.em, bar.bottom + canvas.em};
    CoverageMask mask = emptyMask(enclosing(all, textBox(colorBar.title, title)));
    coverText(mask, colorBar.title, title);
    coverBox(mask, {bar.left - w, bar.top - w, bar.right + w, bar.top});
    coverBox(mask, {bar.left - w, bar.bottom, bar.right + w, bar.bottom + w});
    coverBox(mask, {bar.left - w, bar.top, bar.left, bar.bottom});
    coverBox(mask, {bar.right, bar.top, bar.right + w, bar.bottom});
    for (const Tick& tick : colorBar.ticks) {
        const double row = std::clamp(std::round(bar.bottom - tick.position * (bar.bottom - bar.top) - 0.5 * w),
                                      bar.top, bar.bottom - w);
        coverBox(mask, {bar.right + w, row, bar.right + std::round(0.3 * canvas.em), row + w});
        coverText(mask, tick.text, {bar.right + 0.6 * canvas.em, static_cast<int>(row) + halfCapital, canvas.em});
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
