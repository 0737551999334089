// Pictures of spheres, obstacles, ground and background against the oracle.
#include "tests/catch.h"

#include "tests/render/pictures.h"

using namespace pictures;
using render::Quality;

namespace {

constexpr render::PictureSize kSize{121, 75};  // not a multiple of the tile size

// Channels may differ by one step of 1/255: bytes are rounded, and single precision adds far less than a step.
constexpr int kStep = 1;

void requireAlike(By by, const render::View& view, double share) {
    const Difference difference = differenceFromOracle(by, view, kSize, kStep);
    INFO(difference);
    REQUIRE(difference.sameSize);
    CHECK(difference.share <= share);
    // One channel in fifty may be a step off by rounding (counted once: one in 600), and each pixel on an outline 60
    // steps.
    CHECK(difference.mean < 0.02 + 60.0 * share);
}

}  // namespace

TEST_CASE("The comparison finds a wrong picture") {
    const render::View view = cloud(50);
    const render::Image good = drawn(view, kSize, Quality::draft);
    CHECK(compare(good, good, 0).largest == 0);
    render::Image bad = good;
    for (std::size_t k = 0; k < 3 * 121 * 4; ++k) bad.rgb[k] = static_cast<std::uint8_t>(255 - bad.rgb[k]);
    CHECK(compare(good, bad, kStep).share > 0.04);  // 4 of 75 rows
    render::View moved = view;
    moved.camera.eye.x += 0.05F;
    CHECK(compare(good, drawn(moved, kSize, Quality::draft), kStep).share > 0.05);
    CHECK_FALSE(compare(good, render::Image{1, 1, {0, 0, 0}}, 0).sameSize);
}

TEST_CASE("Spheres, perspective and orthographic, are those of the oracle") {
    const By by = GENERATE(from_range(renderers()));
    CAPTURE(by);
    render::View view = cloud(200);
    // 2 pixels of 9075: of some 3000 pixels on outlines, those whose ray passes an outline so closely that single
    // precision decides otherwise.
    requireAlike(by, view, 2.0 / 9075.0);
    view.camera.projection = render::Projection::orthographic;
    view.camera.halfHeight = 2.0F;
    requireAlike(by, view, 2.0 / 9075.0);  // pixels on outlines, as above
}

TEST_CASE("Obstacles, ground and background are those of the oracle") {
    const By by = GENERATE(from_range(renderers()));
    CAPTURE(by);
    requireAlike(by, cloudWithObstacles(60), 2.0 / 9075.0);  // pixels on outlines, as in the first test
    render::View view = cloudWithObstacles(0);
    view.surface.specular = 0.0F;
    requireAlike(by, view, 2.0 / 9075.0);
    view.ground.reset();
    requireAlike(by, view, 2.0 / 9075.0);
    requireAlike(by, render::View{}, 0.0);  // a black picture
}

TEST_CASE("Seen from below the ground hides what is above it") {
    const By by = GENERATE(from_range(renderers()));
    CAPTURE(by);
    render::View view = cloudWithObstacles(40);
    view.camera.eye.y = -1.0F;
    requireAlike(by, view, 2.0 / 9075.0);  // pixels on outlines, as in the first test
}

TEST_CASE("Spheres far off the axis stay exact") {
    const By by = GENERATE(from_range(renderers()));
    CAPTURE(by);
    render::View view = cloud(40);
    view.camera.verticalFov = 2.2F;
    view.camera.eye = {0.3F, 1.5F, 2.0F};
    requireAlike(by, view, 2.0 / 9075.0);  // pixels on outlines, as in the first test
}

TEST_CASE("Shadows are the oracle's up to their softened edge") {
    const By by = GENERATE(from_range(renderers()));
    CAPTURE(by);
    render::View view = cloudWithObstacles(120);
    view.light.shadows = true;
    // A shadow's edge is a pixel wide here and sharp in the oracle, so only pixels on shadows' outlines differ (counted
    // once: 0.02). Without any shadow 0.075 of the pixels differ (next test), so 0.03 tells the two apart.
    requireAlike(by, view, 0.03);
    view.camera.projection = render::Projection::orthographic;
    view.camera.halfHeight = 2.0F;
    requireAlike(by, view, 0.03);
    view.light.toLight = {0.0F, 1.0F, 0.0F};  // along an axis, parallel to the sides of boxes
    requireAlike(by, view, 0.03);
}

TEST_CASE("Shadows are shadows: without them the picture is another") {
    const By by = GENERATE(from_range(renderers()));
    CAPTURE(by);
    render::View view = cloudWithObstacles(120);
    const render::Image lit = drawn(by, view, kSize, Quality::draft);
    view.light.shadows = true;
    CHECK(compare(lit, drawn(by, view, kSize, Quality::draft), kStep).share > 0.04);  // counted once: 0.075
}

TEST_CASE("Better quality is nearer to the exact picture", "[long]") {
    const By by = GENERATE(from_range(renderers()));
    CAPTURE(by);
    render::View view = cloudWithObstacles(150);
    view.light.shadows = true;
    const render::Image exact = fromOracle(view, kSize, 6);
    const double draft = compare(drawn(by, view, kSize, Quality::draft), exact, 0).mean;
    const double normal = compare(drawn(by, view, kSize, Quality::normal), exact, 0).mean;
    const double final = compare(drawn(by, view, kSize, Quality::final), exact, 0).mean;
    CAPTURE(draft, normal, final);
    CHECK(normal < 0.6 * draft);   // four samples at outlines have half the error of one
    CHECK(final < 0.75 * normal);  // nine samples have two thirds of the error of four
    CHECK(final < 1.5);            // steps; chosen for nine samples against 36
}
