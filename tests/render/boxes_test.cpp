// Very many boxes: the lists by tiles of the picture and by cells of the light's plane leave nothing out.
#include "tests/catch.h"

#include <cmath>
#include <vector>

#include "tests/render/many_boxes.h"

using namespace pictures;
using render::BoxObstacle;
using render::Quality;

namespace {

constexpr render::PictureSize kSize{121, 75};
constexpr double kPixels = 121.0 * 75.0;

}  // namespace

TEST_CASE("Hundreds of boxes are drawn as by the oracle") {
    const By by = GENERATE(from_range(renderers()));
    CAPTURE(by);
    for (const auto projection : {render::Projection::perspective, render::Projection::orthographic}) {
        render::View view = viewOf(randomBoxes(300));
        view.light.shadows = false;
        view.camera.projection = projection;
        view.camera.halfHeight = 2.5F;
        const Difference difference = differenceFromOracle(by, view, kSize, 1);
        INFO(difference);
        // Pixels on outlines and on edges where boxes meet, where single precision may decide otherwise.
        CHECK(difference.share <= 10.0 / kPixels);
    }
}

TEST_CASE("The eye among hundreds of boxes") {
    const By by = GENERATE(from_range(renderers()));
    CAPTURE(by);
    render::View view = viewOf(city(20));
    view.light.shadows = false;
    view.camera.eye = {0.32F, 0.25F, 0.41F};
    view.camera.target = {-1.0F, 0.3F, -2.0F};
    const Difference difference = differenceFromOracle(by, view, kSize, 1);
    INFO(difference);
    CHECK(difference.share <= 10.0 / kPixels);  // on outlines, as above
}

TEST_CASE("The soft shadows of hundreds of boxes are the oracle's, from above and at a grazing angle", "[long]") {
    const By by = GENERATE(from_range(renderers()));
    CAPTURE(by);
    for (const glm::vec3 toLight : {glm::vec3(0.5F, 0.8F, 0.3F), glm::vec3(0.0F, 1.0F, 0.0F),
                                    glm::vec3(0.9F, 0.06F, -0.3F), glm::vec3(1.0F, 0.0F, 0.0F)}) {
        for (const bool isCity : {true, false}) {
            render::View view = viewOf(isCity ? city(18) : randomBoxes(300));
            view.light.toLight = glm::normalize(toLight);
            view.light.softness = 1.0F;
            CAPTURE(toLight.x, toLight.y, toLight.z, isCity);
            const Difference difference = differenceFromOracle(by, view, kSize, 2);
            INFO(difference);
            // Where a box touches the surface, and the edge is narrower than a pixel, it is a pixel wide here and sharp
            // in the oracle.
            CHECK(difference.share < 0.05);  // counted once: 0.046 under the light from above, less under the others
            CHECK(difference.mean < 1.0);    // 0.75 there
        }
    }
}

TEST_CASE("Boxes that nobody sees and that shade nothing do not change the picture") {
    const By by = GENERATE(from_range(renderers()));
    CAPTURE(by);
    for (const float softness : {0.0F, 0.6F}) {
        render::View view = viewOf(randomBoxes(200));
        view.light.softness = softness;
        const render::Image plain = drawn(by, view, kSize, Quality::draft);
        // Below the ground, in the direction away from the light, and far from the others: all cells are others.
        Random random(17);
        for (int k = 0; k < 150; ++k) {
            const glm::vec3 at = random.pointWithin({-60.0F, -9.0F, -60.0F}, {60.0F, -3.0F, 60.0F});
            view.boxObstacles.push_back({at, at + 0.5F, glm::vec3(0.5F)});
        }
        view.boxObstacles.push_back({{-900.0F, -2000.0F, 0.0F}, {-880.0F, -1000.0F, 5.0F}, glm::vec3(0.5F)});
        const Difference difference = compare(drawn(by, view, kSize, Quality::draft), plain, 0);
        INFO("softness " << softness << ": " << difference);
        // Open ground is colored from one color of the whole ground, other ground point by point.
        CHECK(difference.largest <= 1);
        CHECK(difference.share < 1e-3);
    }
}

TEST_CASE("Boxes far beyond the others shade them") {
    const By by = GENERATE(from_range(renderers()));
    CAPTURE(by);
    render::View view = viewOf(city(12));
    view.light.softness = 0.5F;
    const render::Image sunny = drawn(by, view, kSize, Quality::draft);
    // Two roofs over a part of the city, one of them near the light, and a wall beyond its border.
    const glm::vec3 toLight = glm::normalize(view.light.toLight);
    for (const float distance : {30.0F, 200.0F}) {
        const glm::vec3 at = distance * toLight + glm::vec3(0.01F * distance, 0.0F, 0.5F);
        view.boxObstacles.push_back({at - glm::vec3(0.6F, 0.1F, 0.6F), at + glm::vec3(0.6F, 0.1F, 0.6F)});
    }
    view.boxObstacles.push_back({{9.0F, 0.003F, -8.0F}, {9.5F, 16.0F, 8.0F}, glm::vec3(0.5F)});
    CHECK(compare(drawn(by, view, kSize, Quality::draft), sunny, 8).share > 0.03);
    const Difference difference = differenceFromOracle(by, view, kSize, 2);
    INFO(difference);
    CHECK(difference.share < 0.02);
    CHECK(difference.mean < 0.2);
}

TEST_CASE("A wide line behind a wall is hidden beside the wall too") {
    const By by = GENERATE(from_range(renderers()));
    CAPTURE(by);
    // The line is wider than a tile, and pixels above the wall belong to points of it that the wall hides.
    for (const int slices : {1, 64}) {
        render::View view = cloud(0);
        const auto edge = [&](int slice) {
            return -0.503F + 1.006F * static_cast<float>(slice) / static_cast<float>(slices);
        };
        for (int k = 0; k < slices; ++k)
            view.boxObstacles.push_back({{edge(k), 0.21F, 1.0F}, {edge(k + 1), 1.203F, 1.2F}, glm::vec3(0.6F)});
        const render::Image without = drawn(by, view, kSize, Quality::draft);
        view.edges.push_back({{-0.6F, 0.3F, 0.5F}, {0.0F, 0.7F, 0.5F}, {1.0F, 0.9F, 0.0F}, 64.0F});
        const Difference difference = compare(drawn(by, view, kSize, Quality::draft), without, 0);
        INFO(slices << " slices: " << difference);
        CHECK(difference.largest <= 1);  // of ground beside the line, colored in another way
        view.boxObstacles.clear();
        CHECK(compare(drawn(by, view, kSize, Quality::draft), without, 8).share > 0.1);
    }
}

TEST_CASE("Of boxes whose faces lie in one plane the first is seen") {
    const By by = GENERATE(from_range(renderers()));
    CAPTURE(by);
    // Seen at an angle, the wide box is nearer to the eye than the narrow one in its middle.
    const BoxObstacle narrow{{-0.5F, 0.2F, 0.0F}, {0.5F, 1.2F, 1.0F}, {0.9F, 0.1F, 0.1F}};
    const BoxObstacle wide{{-2.0F, 0.1F, -1.0F}, {2.0F, 1.3F, 1.0F}, {0.1F, 0.1F, 0.9F}};
    for (const bool isNarrowFirst : {true, false}) {
        render::View view = cloud(0);
        view.camera.eye = {3.0F, 1.0F, 5.0F};
        view.camera.target = {0.0F, 0.7F, 1.0F};
        view.boxObstacles = {isNarrowFirst ? narrow : wide, isNarrowFirst ? wide : narrow};
        const render::Image image = drawn(by, view, kSize, Quality::draft);
        const std::size_t middle = 3 * (37 * 121 + 60);
        CAPTURE(isNarrowFirst, int(image.rgb[middle]), int(image.rgb[middle + 2]));
        CHECK((image.rgb[middle] > image.rgb[middle + 2]) == isNarrowFirst);
    }
}

#ifdef RENDER_HAS_OPENGL
TEST_CASE("OpenGL draws a city as the CPU does", "[opengl]") {
    for (const render::Style style : {render::Style::spheres, render::Style::metaballs}) {
        for (const float softness : {0.0F, 0.7F}) {
            // From above, and at a grazing angle.
            for (const glm::vec3 toLight : {glm::vec3(0.5F, 0.8F, 0.3F), glm::vec3(0.37F, 0.05F, 0.92F)}) {
                render::View view = viewOf(city(20));
                view.style = style;
                view.camera.eye.y = 1.5F;
                view.light.toLight = glm::normalize(toLight);
                view.light.softness = softness;
                view.edges.push_back({{-2.0F, 0.5F, -2.0F}, {2.0F, 0.5F, 2.0F}});
                const Difference difference = compare(drawn(By::openGl, view, kSize, Quality::draft),
                                                      drawn(By::cpu, view, kSize, Quality::draft), 1);
                INFO("style " << int(style) << ", softness " << softness << ": " << difference);
                CHECK(difference.share <= (style == render::Style::spheres ? 2.0 : 12.0) / kPixels);
            }
        }
    }
}

TEST_CASE("OpenGL draws the shadows of boxes where pixels are wide as the CPU does", "[opengl]") {
    // Small boxes behind the camera cast their shadows on a wall far before it.
    render::View view = viewOf(city(12));
    for (BoxObstacle& box : view.boxObstacles) {
        box.minimum += glm::vec3(0.0F, box.maximum.y + 1.0F, 9.0F);
        box.maximum = box.minimum + 0.1F;
    }
    const BoxObstacle wall{{-8.0F, -1.0F, -9.0F}, {8.0F, 4.0F, -8.0F}, glm::vec3(0.7F)};
    view.boxObstacles.push_back(wall);
    view.camera.eye = {0.5F, 1.5F, 5.0F};
    view.camera.target = {0.0F, 1.0F, -8.0F};
    view.light.toLight = glm::normalize(glm::vec3(0.1F, 0.07F, 0.95F));
    const render::Image byCpu = drawn(By::cpu, view, kSize, Quality::draft);
    const Difference difference = compare(drawn(By::openGl, view, kSize, Quality::draft), byCpu, 1);
    INFO(difference);
    CHECK(difference.largest <= 1);  // single precision, rounded to bytes
    view.boxObstacles = {wall};
    CHECK(compare(drawn(By::cpu, view, kSize, Quality::draft), byCpu, 8).share > 0.02);
}
#endif

TEST_CASE("Pixels at the outline of a box show it by the share that it covers, not by four samples alone", "[long]") {
    const By by = GENERATE(from_range(renderers()));
    CAPTURE(by);
    render::View view;
    view.background = {glm::vec3(1.0F), glm::vec3(1.0F)};
    view.ambient = {glm::vec3(1.0F), glm::vec3(1.0F)};
    view.light.color = glm::vec3(0.0F);
    view.boxObstacles = {{{-1.0F, -0.6F, -0.7F}, {1.1F, 0.5F, 0.8F}, glm::vec3(0.0F)}};
    view.camera.verticalFov = 0.5F;
    double squares = 0.0;
    int count = 0;
    // Slopes near 1/3, where samples of a pixel lie in pairs at the same distance from the outline, and others.
    for (const glm::vec3 eye :
         {glm::vec3(2.4F, 3.9F, 6.9F), glm::vec3(-0.5F, 1.0F, 8.0F), glm::vec3(5.0F, 5.0F, 5.0F)}) {
        for (const auto projection : {render::Projection::perspective, render::Projection::orthographic}) {
            view.camera.eye = eye;
            view.camera.projection = projection;
            view.camera.halfHeight = 2.0F;
            const render::PictureSize size{160, 120};
            const render::Image image = drawn(by, view, size, render::Quality::normal);
            const render::Image exact = fromOracle(view, size, 16);
            for (std::size_t k = 0; k < image.rgb.size(); k += 3) {
                const auto linear = [](std::uint8_t byte) { return std::pow(byte / 255.0, 2.2); };
                if (exact.rgb[k] == 0 || exact.rgb[k] == 255) continue;
                squares += std::pow(linear(image.rgb[k]) - linear(exact.rgb[k]), 2.0);
                ++count;
            }
        }
    }
    const double error = std::sqrt(squares / count);
    CAPTURE(count, error);
    CHECK(count > 1000);
    // Measured: 0.049 of the contrast, most of it in pixels that an outline crosses beside all of their samples. Four
    // samples alone: 0.084.
    CHECK(error < 0.06);
}
