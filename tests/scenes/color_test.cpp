// Tests the sRGB curve against its definition, hexadecimal colors, and ramps.
#include "tests/catch.h"

#include <cmath>

#include "scenes/text/color.h"

using engine::Vec3;
using scenes::colorFromHex;
using scenes::linearFromSrgb;
using scenes::rampColor;

TEST_CASE("the sRGB curve has the values of its definition") {
    CHECK(linearFromSrgb(0.0) == 0.0);
    CHECK(linearFromSrgb(1.0) == 1.0);
    // Linear below the knee: 0.04045 / 12.92.
    CHECK(linearFromSrgb(0.04045) == Approx(0.0031308049535603713).epsilon(1e-15));
    // ((0.5 + 0.055) / 1.055)^2.4 = exp(2.4 ln(0.5260663507...)), by bc with 30 digits.
    CHECK(linearFromSrgb(0.5) == Approx(0.21404114048223255).epsilon(1e-14));
    // The two pieces of the curve meet within the rounding of the standard's constants, 3e-8.
    CHECK(std::abs(linearFromSrgb(0.04045 + 1e-12) - linearFromSrgb(0.04045)) < 1e-7);
}

TEST_CASE("hexadecimal colors may have either case, and other texts are no colors") {
    CHECK(*colorFromHex("#ffffff") == Vec3(1.0, 1.0, 1.0));
    CHECK(*colorFromHex("#000000") == Vec3(0.0, 0.0, 0.0));
    CHECK(*colorFromHex("#FF8000") == *colorFromHex("#ff8000"));
    CHECK(*colorFromHex("#ff8000") == Vec3(1.0, linearFromSrgb(128.0 / 255.0), 0.0));
    CHECK(*colorFromHex("#000001") == Vec3(0.0, 0.0, 1.0 / 255.0 / 12.92));
    for (const char* text : {"", "#", "#fff", "ffffff", "#fffffff", "#ggffff", "#fffff ", "red"})
        CHECK(!colorFromHex(text));
}

TEST_CASE("a ramp is linear between its colors and constant beyond them") {
    const std::vector<Vec3> colors = {Vec3(0.0, 0.0, 0.0), Vec3(1.0, 0.5, 0.0), Vec3(1.0, 1.0, 1.0)};
    CHECK(rampColor(colors, -3.0) == colors[0]);
    CHECK(rampColor(colors, 0.0) == colors[0]);
    CHECK(rampColor(colors, 0.25) == Vec3(0.5, 0.25, 0.0));
    CHECK(rampColor(colors, 0.5) == colors[1]);
    CHECK(rampColor(colors, 0.75) == Vec3(1.0, 0.75, 0.5));
    CHECK(rampColor(colors, 1.0) == colors[2]);
    CHECK(rampColor(colors, 1e300) == colors[2]);
    CHECK(rampColor(colors, std::nan("")) == colors[0]);
    CHECK(rampColor({Vec3(0.1, 0.2, 0.3)}, 0.7) == Vec3(0.1, 0.2, 0.3));
}
