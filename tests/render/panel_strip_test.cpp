// Strips of panels: pixels unchanged, in order and with gaps; each text below its own panel.
#include "tests/catch.h"

#include <stdexcept>

#include "render/overlay/panel_strip.h"

using render::Image;

namespace {

Image plain(int width, int height, std::uint8_t gray) {
    Image image{width, height, {}};
    image.rgb.assign(image.byteCount(), gray);
    return image;
}

std::uint8_t byteAt(const Image& image, int x, int y) {
    return image.rgb.at(static_cast<std::size_t>(3 * (y * image.width + x)));
}

}  // namespace

TEST_CASE("Panels stand side by side with thin white lines between them") {
    const Image strip =
        render::joinPanels({{plain(100, 60, 10), "a"}, {plain(100, 60, 20), "b"}, {plain(100, 60, 30), "c"}});
    const int gap = (strip.width - 300) / 2;
    CHECK(strip.width == 300 + 2 * gap);
    CHECK(gap >= 2);
    CHECK(gap <= 4);
    for (int y = 0; y < 60; ++y)
        for (int x = 0; x < strip.width; ++x) {
            const int within = x % (100 + gap);
            const int expected = within >= 100 ? 255 : 10 * (1 + x / (100 + gap));
            CHECK(byteAt(strip, x, y) == expected);
        }
}

TEST_CASE("Every text stands below the middle of its panel, and one without text has none") {
    const Image strip = render::joinPanels({{plain(160, 60, 10), "t = 0.5 s"}, {plain(160, 60, 20), ""}});
    REQUIRE(strip.height > 75);
    double sum = 0.0;
    double ink = 0.0;
    int rightmost = 0;
    for (int y = 60; y < strip.height; ++y)
        for (int x = 0; x < strip.width; ++x) {
            const int dark = 255 - byteAt(strip, x, y);
            sum += dark * (x + 0.5);
            ink += dark;
            if (dark > 0) rightmost = x;
            if (y == strip.height - 1 || y == 60) CHECK(dark == 0);
        }
    REQUIRE(ink > 255.0 * 30.0);  // 30 fully covered pixels at least
    CHECK(rightmost < 160);
    CHECK(sum / ink == Approx(80.0).margin(8.0));  // letters differ in weight: a tenth of the text's width
}

TEST_CASE("A strip of nothing or of unequal panels is refused") {
    CHECK_THROWS_AS(render::joinPanels({}), std::logic_error);
    CHECK_THROWS_AS(render::joinPanels({{plain(10, 10, 0), ""}, {plain(10, 11, 0), ""}}), std::logic_error);
}

TEST_CASE("A text wider than its panel shrinks to fit") {
    const Image strip = render::joinPanels({{plain(24, 60, 10), "t = 12.25 s"}, {plain(24, 60, 20), "t = 12.50 s"}});
    const int gap = strip.width - 48;
    int ink = 0;
    int between = 0;
    for (int y = 60; y < strip.height; ++y)
        for (int x = 0; x < strip.width; ++x) {
            const int dark = 255 - byteAt(strip, x, y);
            ink += dark;
            if (x >= 24 && x < 24 + gap) between += dark;
        }
    CHECK(ink > 255 * 10);
    CHECK(between < ink / 50);  // at most the antialiased edges of the outermost letters
}
