// Extreme views: no particle, one, very many, particles around the eye, odd picture sizes, numbers that are not finite.
#include "tests/catch.h"

#include <cmath>
#include <limits>

#include "tests/render/pictures.h"

using namespace pictures;
using render::Quality;
using render::Style;

namespace {

constexpr render::PictureSize kSize{121, 75};

/// Up to 4 of 9075 pixels may differ, on outlines, where single precision may decide otherwise, and others by 2 steps,
/// because the normals of metaballs are packed.
void requireOracle(By by, const render::View& view) {
    const Difference difference = differenceFromOracle(by, view, kSize, 2);
    INFO(difference);
    CHECK(difference.share <= 4.0 / 9075.0);
}

}  // namespace

TEST_CASE("No particle and one particle") {
    const By by = GENERATE(from_range(renderers()));
    CAPTURE(by);
    for (const Style style : {Style::spheres, Style::metaballs}) {
        for (const int count : {0, 1}) {
            render::View view = cloud(count);
            view.style = style;
            requireOracle(by, view);
        }
    }
}

TEST_CASE("The eye inside a particle") {
    const By by = GENERATE(from_range(renderers()));
    CAPTURE(by);
    for (const Style style : {Style::spheres, Style::metaballs}) {
        render::View view = cloud(30);
        view.style = style;
        view.particles.push_back({view.camera.eye + glm::vec3(0.1F, 0.0F, 0.05F), 0.4F, {0.5F, 0.9F, 0.1F}});
        requireOracle(by, view);
    }
}

TEST_CASE("Particles across the eye's plane and behind the eye") {
    const By by = GENERATE(from_range(renderers()));
    CAPTURE(by);
    for (const Style style : {Style::spheres, Style::metaballs}) {
        render::View view = cloud(30);
        view.style = style;
        const glm::vec3 forward = glm::normalize(view.camera.target - view.camera.eye);
        const glm::vec3 right = glm::normalize(glm::cross(forward, view.camera.up));
        view.particles.push_back({view.camera.eye + 0.5F * right + 0.02F * forward, 0.3F, {0.9F, 0.9F, 0.1F}});
        view.particles.push_back({view.camera.eye - 2.0F * forward, 0.5F, {0.9F, 0.0F, 0.1F}});
        requireOracle(by, view);
    }
}

TEST_CASE("The eye inside a box") {
    const By by = GENERATE(from_range(renderers()));
    CAPTURE(by);
    render::View view = cloud(30);
    view.boxObstacles.push_back(
        {view.camera.eye - glm::vec3(0.3F, 0.2F, 0.4F), view.camera.eye + glm::vec3(0.3F), {0.3F, 0.6F, 0.3F}});
    requireOracle(by, view);
}

TEST_CASE("Pictures of odd sizes are cut from the same picture") {
    const By by = GENERATE(from_range(renderers()));
    CAPTURE(by);
    const render::View view = cloud(20);
    for (const render::PictureSize size : {render::PictureSize{1, 1}, {1, 40}, {17, 3}, {33, 17}, {16, 16}, {255, 3}}) {
        for (const Quality quality : {Quality::draft, Quality::normal, Quality::final}) {
            // Shaders are compiled for each size and quality.
            if (by == By::openGl && quality != Quality::draft && size.width != 33) continue;
            const render::Image image = drawn(by, view, size, quality);
            CHECK(image.width == size.width);
            CHECK(image.height == size.height);
            CHECK(image.rgb.size() == image.byteCount());
        }
        const Difference difference = differenceFromOracle(by, view, size, 1);
        INFO(difference);
        CHECK(difference.share * size.width * size.height <= 1.0);  // one pixel on an outline
    }
}

TEST_CASE("Fifty thousand particles") {
    const By by = GENERATE(from_range(renderers()));
    CAPTURE(by);
    render::View view = cloud(50000);
    for (render::Sphere& particle : view.particles) particle.radius *= 0.15F;
    view.light.shadows = true;
    // OpenGL draws with the shaders of other tests.
    const render::PictureSize size = by == By::cpu ? render::PictureSize{320, 180} : kSize;
    const Quality quality = by == By::cpu ? Quality::normal : Quality::draft;
    for (const Style style : {Style::spheres, Style::metaballs}) {
        view.style = style;
        const render::Image image = drawn(by, view, size, quality);
        const Difference difference = compare(image, drawn(by, cloud(0), size, quality), 8);
        INFO(difference);
        CHECK(difference.share > 0.2);  // the cloud covers a good part of the picture
    }
}

TEST_CASE("Every particle in every tile") {
    render::View view = cloud(0);
    for (int k = 0; k < 3000; ++k)
        view.particles.push_back({{0.001F * float(k % 50), 1.0F, 0.0F}, 6.0F, {0.2F, 0.4F, 0.6F}});
    const render::Image image = drawn(view, {320, 180}, Quality::normal);
    // The eye is inside of all of them: every pixel shows a particle at depth 0, and none the background.
    CHECK(compare(image, drawn(cloud(0), {320, 180}, Quality::normal), 2).share > 0.95);
}

TEST_CASE("A particle without size is not drawn") {
    const By by = GENERATE(from_range(renderers()));
    CAPTURE(by);
    render::View view = cloud(0);
    const render::Image empty = drawn(by, view, kSize, Quality::normal);
    view.particles.push_back({{0.0F, 1.0F, 0.0F}, 0.0F, {1.0F, 0.0F, 0.0F}});
    for (const Style style : {Style::spheres, Style::metaballs}) {
        view.style = style;
        CHECK(drawn(by, view, kSize, Quality::normal).rgb == empty.rgb);
    }
}

TEST_CASE("Numbers that are not finite are refused by name") {
    render::View view = cloud(3);
    view.particles[1].center.y = std::numeric_limits<float>::quiet_NaN();
    CHECK_THROWS_WITH(drawn(view, kSize, Quality::draft), Catch::Contains("particle 1 of 3"));
}
