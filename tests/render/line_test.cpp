// Lines have a width in pixels and are hidden by what is nearer, at any quality.
#include "tests/catch.h"

#include "tests/render/pictures.h"

using namespace pictures;
using render::Quality;

namespace {

constexpr render::PictureSize kSize{64, 48};

/// A white horizontal line through the middle of a black picture, at z = 0, seen from z = 10. @param width  pixels
render::View lineView(float width) {
    render::View view;
    view.camera.eye = {0.0F, 0.0F, 10.0F};
    view.edges.push_back({{-20.0F, 0.0F, 0.0F}, {20.0F, 0.0F, 0.0F}, glm::vec3(1.0F), width});
    return view;
}

/// The linear light of one column of the picture, in white pixels.
double lightInColumn(const render::Image& image, int x) {
    double sum = 0.0;
    for (int y = 0; y < image.height; ++y) {
        const double s = image.rgb[static_cast<std::size_t>(3 * (y * image.width + x))] / 255.0;
        sum += s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
    }
    return sum;
}

}  // namespace

TEST_CASE("A line is as wide as it says, at any quality") {
    const By by = GENERATE(from_range(renderers()));
    CAPTURE(by);
    for (const Quality quality : {Quality::draft, Quality::normal, Quality::final}) {
        for (const float width : {0.5F, 1.0F, 1.5F, 3.0F}) {
            CAPTURE(width);
            const double light = lightInColumn(drawn(by, lineView(width), kSize, quality), 30);
            CHECK(light ==
                  Approx(double(width)).margin(0.03));  // bytes: 0.01 of linear light in each of two gray pixels
        }
    }
}

TEST_CASE("A line is hidden by what is nearer only") {
    const By by = GENERATE(from_range(renderers()));
    CAPTURE(by);
    render::View view = lineView(2.0F);
    view.particles.push_back({{-1.0F, 0.0F, 2.0F}, 0.6F, {0.0F, 0.0F, 0.0F}});
    view.particles.push_back({{1.5F, 0.0F, -2.0F}, 0.6F, {0.0F, 0.0F, 0.0F}});
    view.light.color = glm::vec3(0.0F);
    for (const render::Style style : {render::Style::spheres, render::Style::metaballs}) {
        view.style = style;
        const render::Image image = drawn(by, view, kSize, Quality::normal);
        // The particles are in the columns 32 - 1.0 * 48 / (8 * 0.73) and 32 + 1.5 * 48 / (12 * 0.73): 48 rows see 0.73
        // m of height per meter of depth, and the particles are 8 m and 12 m away.
        CHECK(lightInColumn(image, 24) < 0.01);
        CHECK(lightInColumn(image, 40) > 1.9);
        CHECK(lightInColumn(image, 2) > 1.9);
    }
}

TEST_CASE("The edges of a box show on its near side and not on its far side") {
    const By by = GENERATE(from_range(renderers()));
    CAPTURE(by);
    render::View view;
    view.camera.eye = {3.0F, 2.5F, 6.0F};
    view.boxObstacles.push_back({glm::vec3(-1.0F), glm::vec3(1.0F), glm::vec3(0.0F)});
    view.light.color = glm::vec3(0.0F);
    view.edges.push_back({{-1.0F, 1.0F, 1.0F}, {1.0F, 1.0F, 1.0F}, glm::vec3(1.0F), 2.0F});
    const render::Image near = drawn(by, view, kSize, Quality::normal);
    view.edges[0] = {{-1.0F, -1.0F, -1.0F}, {-1.0F, 0.5F, -1.0F}, glm::vec3(1.0F), 2.0F};
    const render::Image far = drawn(by, view, kSize, Quality::normal);
    const render::Image none = drawn(
        by,
        [&] {
            render::View v = view;
            v.edges.clear();
            return v;
        }(),
        kSize, Quality::normal);
    CHECK(compare(near, none, 40).share * 64 * 48 > 20.0);  // the line is some 15 pixels long and two wide
    CHECK(compare(far, none, 8).largest <= 8);
}

TEST_CASE("Lines through the eye's plane and off the picture do no harm") {
    const By by = GENERATE(from_range(renderers()));
    CAPTURE(by);
    render::View view = lineView(1.5F);
    const render::Image plain = drawn(by, view, kSize, Quality::normal);
    view.edges.push_back({{0.0F, 5.0F, 30.0F}, {0.0F, 5.0F, 20.0F}, glm::vec3(1.0F, 0.0F, 0.0F), 2.0F});
    view.edges.push_back({{500.0F, 5.0F, 0.0F}, {600.0F, 5.0F, 0.0F}, glm::vec3(1.0F, 0.0F, 0.0F), 2.0F});
    CHECK(drawn(by, view, kSize, Quality::normal).rgb == plain.rgb);
    view.edges.push_back({{0.0F, -1.0F, 30.0F}, {0.0F, -1.0F, -30.0F}, glm::vec3(1.0F, 0.0F, 0.0F), 2.0F});
    CHECK(compare(drawn(by, view, kSize, Quality::normal), plain, 8).share >
          0.01);  // the line crosses the lower half of the picture
}
