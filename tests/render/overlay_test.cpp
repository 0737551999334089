// Overlays: where they are drawn, what the text says, the length of the scale bar and the colors of the color bar.
#include "tests/catch.h"

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "render/overlay/draw_overlay.h"
#include "render/overlay/text.h"
#include "tests/render/pictures.h"

using render::Image;
using render::Overlay;

namespace {

Image plain(int width, int height, std::uint8_t gray) {
    Image image{width, height, {}};
    image.rgb.assign(image.byteCount(), gray);
    return image;
}

std::uint8_t byteAt(const Image& image, int x, int y, int channel = 0) {
    return image.rgb.at(static_cast<std::size_t>(3 * (y * image.width + x) + channel));
}

/// The smallest rectangle that contains all pixels with some property; right < left if there are none.
struct Bounds {
    int left = 1 << 20;
    int top = 1 << 20;
    int right = -1;
    int bottom = -1;
    int count = 0;
};

Bounds boundsOf(const Image& image, const std::function<bool(int, int)>& hasProperty) {
    Bounds bounds;
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            if (!hasProperty(x, y)) continue;
            bounds = {std::min(bounds.left, x), std::min(bounds.top, y), std::max(bounds.right, x),
                      std::max(bounds.bottom, y), bounds.count + 1};
        }
    }
    return bounds;
}

Bounds changed(const Image& image, std::uint8_t gray) {
    return boundsOf(image, [&](int x, int y) {
        return byteAt(image, x, y, 0) != gray || byteAt(image, x, y, 1) != gray || byteAt(image, x, y, 2) != gray;
    });
}

Image textImage(const std::string& text, double em) {
    Image image = plain(static_cast<int>(2.0 * em), static_cast<int>(2.0 * em), 0);
    const render::TextPosition position{std::round(0.5 * em), static_cast<int>(1.5 * em), em};
    render::CoverageMask mask = render::emptyMask({0.0, 0.0, 2.0 * em, 2.0 * em});
    render::coverText(mask, text, position);
    render::paint(image, mask, {255, 255, 255});
    return image;
}

Overlay withScaleBar(float length) {
    Overlay overlay;
    overlay.scaleBar = render::ScaleBar{length, "1 m"};
    return overlay;
}

Overlay withColorBar() {
    Overlay overlay;
    overlay.colorBar = render::ColorBar{{{1.0F, 0.0F, 0.0F}, {0.0F, 0.0F, 0.5F}, {0.0F, 0.0F, 1.0F}},
                                        "speed (m/s)",
                                        {{0.0F, "0"}, {0.5F, "2.5"}, {1.0F, "5"}}};
    return overlay;
}

struct Size {
    int width;
    int height;
};

const std::vector<Size> kSizes = {{320, 180}, {544, 543}, {1280, 720}, {1920, 1080}, {1080, 1920}};

/// The length of the scale bar in pixels: the sum of coverage by white ink over the lowest row that has any.
double scaleBarPixels(const Image& image) {
    const Bounds ink = boundsOf(image, [&](int x, int y) { return byteAt(image, x, y) > 0; });
    double sum = 0.0;
    for (int x = 0; x < image.width; ++x) sum += byteAt(image, x, ink.bottom) / 255.0;
    return sum;
}

}  // namespace

TEST_CASE("Without an overlay no byte changes") {
    Image image = pictures::drawn(pictures::cloud(50), {64, 48}, render::Quality::draft);
    const Image before = image;
    render::drawOverlay(image, {}, {});
    CHECK(image.rgb == before.rgb);
}

TEST_CASE("An overlay is drawn over what the renderer draws") {
    render::View view = pictures::cloud(50);
    Image expected = pictures::drawn(view, {160, 90}, render::Quality::normal);
    view.overlay = withColorBar();
    view.overlay.stamp = "t = 1.25 s";
    view.overlay.scaleBar = render::ScaleBar{0.5F, "50 cm"};
    const Image bare = expected;
    render::drawOverlay(expected, view.overlay, view.camera);
    CHECK(expected.rgb != bare.rgb);
    CHECK(pictures::drawn(view, {160, 90}, render::Quality::normal).rgb == expected.rgb);
}

TEST_CASE("Every part stays in its corner, off the sides of the picture") {
    for (const Size size : kSizes) {
        INFO(size.width << " x " << size.height);
        const double em = render::overlayEm(size.width, size.height, 1.0);
        const auto drawnBounds = [&](const Overlay& overlay) {
            Image image = plain(size.width, size.height, 128);
            render::drawOverlay(image, overlay, {});
            const Bounds bounds = changed(image, 128);
            REQUIRE(bounds.count > em * em);
            CHECK(bounds.left > 0);
            CHECK(bounds.top > 0);
            CHECK(bounds.right < size.width - 1);
            CHECK(bounds.bottom < size.height - 1);
            return bounds;
        };
        Overlay stamp;
        stamp.stamp = "t = 1.25 s";
        const Bounds upperLeft = drawnBounds(stamp);
        CHECK(upperLeft.right < 7.0 * em);
        CHECK(upperLeft.bottom < 2.0 * em);
        const Bounds lowerLeft = drawnBounds(withScaleBar(1.0F));
        CHECK(lowerLeft.left < em);
        CHECK(lowerLeft.top > size.height - 3.0 * em);
        const Bounds lowerRight = drawnBounds(withColorBar());
        CHECK(lowerRight.left > size.width - 9.0 * em);
        CHECK(lowerRight.top > size.height - 14.0 * em);
    }
}

TEST_CASE("Text has the height that the size of the picture asks for") {
    CHECK(render::overlayEm(320, 180, 1.0) == 11.0);
    CHECK(render::overlayEm(1920, 1080, 1.0) == Approx(32.4));
    CHECK(render::overlayEm(1080, 1920, 2.0) == Approx(64.8));
    for (const double em : {11.0, 21.6, 32.4, 64.0}) {
        INFO(em);
        const Image letter = textImage("H", em);
        const Bounds ink = boundsOf(letter, [&](int x, int y) { return byteAt(letter, x, y) > 127; });
        // DejaVu Sans: capitals are 1493 of 2048 units high.
        CHECK(std::abs(ink.bottom - ink.top + 1 - 1493.0 / 2048.0 * em) <= 1.0);
        CHECK(ink.bottom == static_cast<int>(1.5 * em) - 1);
    }
}

TEST_CASE("Letters stand upright and face the reader") {
    const auto share = [](const Image& image, const Bounds& box, bool right, bool lower) {
        int inked = 0;
        int all = 0;
        for (int y = box.top; y <= box.bottom; ++y) {
            for (int x = box.left; x <= box.right; ++x) {
                if ((2 * x > box.left + box.right) != right || (2 * y > box.top + box.bottom) != lower) continue;
                inked += byteAt(image, x, y) > 127 ? 1 : 0;
                ++all;
            }
        }
        return static_cast<double>(inked) / all;
    };
    const auto quarters = [&](const std::string& letter) {
        const Image image = textImage(letter, 64.0);
        const Bounds box = boundsOf(image, [&](int x, int y) { return byteAt(image, x, y) > 127; });
        return std::vector<double>{share(image, box, false, false), share(image, box, true, false),
                                   share(image, box, false, true), share(image, box, true, true)};
    };
    const auto l = quarters("L");  // a stem on the left, a bar at the bottom
    CHECK(l[1] == 0.0);
    CHECK(l[0] > 0.15);
    CHECK(l[3] > 0.15);
}

TEST_CASE("The stamp says the time") {
    const std::string text = "t = 12.50 s";
    const std::string alphabet = "0123456789.=ts ";
    Image image = plain(1280, 720, 0);
    Overlay overlay;  // white on black: the black halo is invisible
    overlay.stamp = text;
    render::drawOverlay(image, overlay, {});
    const double em = render::overlayEm(1280, 720, 1.0);
    const double margin = std::round(0.8 * em);
    std::string read;
    for (std::size_t k = 0; k < text.size(); ++k) {
        // Recognizes character k as the one whose picture fits best, over the width of a digit.
        const render::TextPosition position{margin + render::textWidth(text.substr(0, k), em),
                                            static_cast<int>(margin + std::round(0.73 * em)), em};
        char best = '?';
        double least = 1e300;
        for (const char candidate : alphabet) {
            const std::string one(1, candidate);
            const double width = render::textWidth(one, em);
            render::CoverageMask mask =
                render::emptyMask({position.left, 0.0, position.left + std::max(width, 0.6 * em), 3.0 * em});
            render::coverText(mask, one, position);
            double sum = 0.0;
            for (int y = 0; y < mask.height; ++y)
                for (int x = 0; x < static_cast<int>(width); ++x)
                    sum += std::abs(mask.coverage.at(static_cast<std::size_t>(y * mask.width + x)) -
                                    static_cast<int>(byteAt(image, mask.left + x, y)));
            sum /= std::max(1.0, std::floor(width));
            if (sum < least) {
                least = sum;
                best = candidate;
            }
        }
        read += best;
    }
    CHECK(read == text);
}

TEST_CASE("The scale bar is as long as the camera makes it") {
    for (const Size size : kSizes) {
        for (const double length : {0.375, 1.0}) {
            INFO(size.width << " x " << size.height << ", " << length << " m");
            render::Camera camera;
            camera.eye = {3.0F, 4.0F, 12.0F};
            camera.target = {0.0F, 1.0F, 0.0F};
            const double distance = std::sqrt(9.0 + 9.0 + 144.0);
            Image image = plain(size.width, size.height, 0);
            render::drawOverlay(image, withScaleBar(static_cast<float>(length)), camera);
            const double perspective = length * size.height / (2.0 * distance * std::tan(0.5 * camera.verticalFov));
            CHECK(scaleBarPixels(image) ==
                  Approx(perspective).margin(0.02));  // rounding to 1/255 at both ends, and of floats

            camera.projection = render::Projection::orthographic;
            camera.halfHeight = 6.0F;
            image = plain(size.width, size.height, 0);
            render::drawOverlay(image, withScaleBar(static_cast<float>(length)), camera);
            CHECK(scaleBarPixels(image) == Approx(length * size.height / 12.0).margin(0.02));
        }
    }
}

TEST_CASE("The scale bar is as long as a distance drawn at the target") {
    render::View view;
    view.camera.eye = {0.3F, 5.0F, 9.0F};  // above the target, so that the picture's horizontal is the x axis
    view.camera.target = {0.3F, 1.0F, -0.5F};
    for (const float x : {-0.7F, 1.3F})  // dots with a diameter of three pixels
        view.edges.push_back({{x, 0.999F, -0.5F}, {x, 1.001F, -0.5F}, glm::vec3(1.0F), 3.0F});
    const Image dots = pictures::drawn(view, {640, 360}, render::Quality::final);
    const auto center = [&](int from, int to) {
        double sum = 0.0;
        double light = 0.0;
        for (int y = 0; y < dots.height; ++y) {
            for (int x = from; x < to; ++x) {
                sum += byteAt(dots, x, y) * (x + 0.5);
                light += byteAt(dots, x, y);
            }
        }
        REQUIRE(light > 255.0);
        return sum / light;
    };
    Image image = plain(640, 360, 0);
    render::drawOverlay(image, withScaleBar(2.0F), view.camera);
    // The centers of dots are found to about a third of a pixel, the distance of the samples.
    CHECK(scaleBarPixels(image) == Approx(center(320, 640) - center(0, 320)).margin(1.0 / 3.0));
}

TEST_CASE("A scale bar that does not fit is left out rather than cut") {
    Image image = plain(320, 180, 90);
    render::drawOverlay(image, withScaleBar(100.0F), {});
    CHECK(changed(image, 90).count == 0);
}

TEST_CASE("The color bar runs through its colors, from bottom to top") {
    for (const Size size : kSizes) {
        INFO(size.width << " x " << size.height);
        Image image = plain(size.width, size.height, 0);
        render::drawOverlay(image, withColorBar(), {});
        const auto isColor = [&](int x, int y) {
            return byteAt(image, x, y, 1) == 0 && byteAt(image, x, y, 0) + byteAt(image, x, y, 2) > 0;
        };
        const Bounds bar = boundsOf(image, isColor);
        const int rows = bar.bottom - bar.top + 1;
        const double em = render::overlayEm(size.width, size.height, 1.0);
        CHECK(bar.count == rows * (bar.right - bar.left + 1));  // a filled rectangle
        CHECK(rows >= std::min(9.5 * em, 0.45 * size.height));
        for (int y = bar.top; y <= bar.bottom; ++y) {
            const double position = (bar.bottom - y + 0.5) / rows;
            const double red = std::max(0.0, 1.0 - 2.0 * position);
            const double blue = position < 0.5 ? position : 0.5 + (position - 0.5);
            // 0.51: half a step of rounding, and floats.
            CHECK(std::abs(byteAt(image, bar.left, y, 0) - pictures::encodedSteps(red)) <= 0.51);
            CHECK(std::abs(byteAt(image, bar.right, y, 2) - pictures::encodedSteps(blue)) <= 0.51);
        }
        // The middle tick is a white line that begins at the frame, halfway up.
        const int beside = bar.right + static_cast<int>(0.25 * em);
        const Bounds ticks = boundsOf(image, [&](int x, int y) {
            return x == beside && y > bar.top + rows / 4 && y < bar.bottom - rows / 4 && byteAt(image, x, y, 1) > 200;
        });
        CHECK(ticks.count >= 1);
        CHECK(std::abs(0.5 * (ticks.top + ticks.bottom) - 0.5 * (bar.top + bar.bottom)) <= 1.0);
    }
}

TEST_CASE("Ink of the picture's own color is visible by its halo") {
    for (const int gray : {0, 255}) {
        Image image = plain(320, 180, static_cast<std::uint8_t>(gray));
        Overlay overlay;
        overlay.stamp = "t = 1.25 s";
        overlay.ink = glm::vec3(static_cast<float>(gray) / 255.0F);
        render::drawOverlay(image, overlay, {});
        const Bounds contrast =
            boundsOf(image, [&](int x, int y) { return std::abs(byteAt(image, x, y) - gray) > 100; });
        CHECK(contrast.count > 100);
    }
}

TEST_CASE("Overlays larger than the picture are cut off at its sides") {
    Overlay overlay = withColorBar();
    overlay.stamp = "t = 123456789.25 s";
    overlay.scaleBar = render::ScaleBar{0.1F, "a long text for a short bar"};
    overlay.size = 4.0F;
    for (const Size size : {Size{16, 16}, Size{64, 48}, Size{16, 300}}) {
        Image image = plain(size.width, size.height, 77);
        render::drawOverlay(image, overlay, {});
        if (size.width > 16) CHECK(changed(image, 77).count > 0);  // a smaller picture consists of the margin
    }
}

TEST_CASE("Text that is not UTF-8 shows replacement characters, and nothing is read beyond its end") {
    const double mark = render::textWidth("\xEF\xBF\xBD", 20.0);
    CHECK(mark > 5.0);
    for (const char* broken : {"\xFF", "\x80", "\xC3", "\xE2\x82", "\xF0\x9F\x98"})
        CHECK(render::textWidth(broken, 20.0) == Approx(mark));
    CHECK(render::textWidth("", 20.0) == 0.0);
    CHECK(render::textWidth("\xC2\xB5m", 20.0) > render::textWidth("m", 20.0));
    // All digits have the same width, so that a running time stamp does not jitter.
    for (const char* digit : {"1", "4", "9"}) CHECK(render::textWidth(digit, 20.0) == render::textWidth("0", 20.0));
}

TEST_CASE("characters that the font lacks are named") {
    CHECK(render::charactersWithoutGlyph("speed m/s, Größe, скорость, ταχύτητα").empty());
    CHECK(render::charactersWithoutGlyph("速度 of 速").compare("速度") == 0);
    CHECK(render::charactersWithoutGlyph("\xff").empty());  // drawn as a replacement character
}

TEST_CASE("letters that are written from right to left are noticed") {
    for (const char* text : {"سرعة", "speed (מהירות)", "\uFEB3"}) CHECK(render::hasRightToLeftLetters(text));
    for (const char* text : {"", "speed", "скорость", "速度", "\xff", "\uFB00"})
        CHECK(!render::hasRightToLeftLetters(text));
}
