// Very many boxes: the lists of boxes by tiles of the picture and by cells of the light's plane leave nothing out.
#include "tests/catch.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <span>
#include <utility>
#include <vector>

#include "render/cpu/lighting/light_visibility.h"
#include "render/prepare/light_space.h"
#include "tests/render/pictures.h"

using namespace pictures;
using render::BoxObstacle;
using render::Quality;

namespace {

constexpr render::PictureSize kSize{121, 75};
constexpr double kPixels = 121.0 * 75.0;

class Random {
 public:
    explicit Random(unsigned seed) : random_(seed) {}
    float between(float low, float high) {
        return low + (high - low) * (static_cast<float>(random_()) / 4294967296.0F);
    }
    glm::vec3 pointWithin(glm::vec3 low, glm::vec3 high) {
        const float x = between(low.x, high.x);
        const float y = between(low.y, high.y);
        return {x, y, between(low.z, high.z)};
    }

 private:
    std::mt19937 random_;
};

/// Boxes of very different sizes that overlap, in the air above the ground and in the ground.
std::vector<BoxObstacle> randomBoxes(int count) {
    Random random(3);
    std::vector<BoxObstacle> boxes;
    for (int k = 0; k < count; ++k) {
        const glm::vec3 at = random.pointWithin({-3.0F, -0.1F, -3.0F}, {3.0F, 2.0F, 3.0F});
        const glm::vec3 size =
            random.between(0.02F, k % 20 == 0 ? 1.0F : 0.3F) * random.pointWithin(glm::vec3(0.2F), glm::vec3(1.0F));
        boxes.push_back({at, at + size, random.pointWithin(glm::vec3(0.1F), glm::vec3(0.9F))});
    }
    return boxes;
}

/// Blocks of different heights in a square of streets.
std::vector<BoxObstacle> city(int side) {
    Random random(5);
    std::vector<BoxObstacle> boxes;
    const float pitch = 6.0F / static_cast<float>(side);
    for (int row = 0; row < side; ++row) {
        for (int column = 0; column < side; ++column) {
            const glm::vec3 corner{pitch * static_cast<float>(column) - 2.97F, 0.003F,
                                   pitch * static_cast<float>(row) - 2.98F};
            const glm::vec3 size{random.between(0.4F, 0.8F) * pitch, random.between(0.1F, 1.2F),
                                 random.between(0.4F, 0.8F) * pitch};
            boxes.push_back({corner, corner + size, random.pointWithin(glm::vec3(0.2F), glm::vec3(0.9F))});
        }
    }
    return boxes;
}

/// A few particles among boxes.
render::View viewOf(std::vector<BoxObstacle> boxes) {
    render::View view = cloud(60);
    view.boxObstacles = std::move(boxes);
    view.light.shadows = true;
    return view;
}

Difference differenceOf(By by, const render::View& view, int limit) {
    return compare(drawn(by, view, kSize, Quality::draft), fromOracle(view, kSize, 1), limit);
}

/// The grid of boxes on the light's plane for a camera that sees all of them.
struct Grid {
    render::LightBasis light;
    glm::vec3 eye{0.0F};
    float softWidth = 0.0F;
    render::LightBoxGrid boxes;

    Grid(const std::vector<BoxObstacle>& obstacles, glm::vec3 toLight, float soft)
        : light(render::lightBasis(toLight)), eye(cloud(0).camera.eye), softWidth(soft) {
        boxes = render::lightBoxGrid(light, render::cameraFrame(cloud(0).camera, {1280, 720}), obstacles, soft);
    }

    /// The list of the cell that a point relative to the eye belongs to.
    std::vector<std::uint32_t> listAt(glm::vec3 point) const {
        const glm::vec2 at = (glm::vec2(light.toLightSpace(point)) - boxes.origin) / boxes.cellSize;
        const auto cell = [](float place, int count) { return std::clamp(static_cast<int>(place), 0, count - 1); };
        const auto list = static_cast<std::size_t>(cell(at.y, boxes.rows) * boxes.columns + cell(at.x, boxes.columns));
        const auto begin = boxes.boxes.index.begin();
        return {begin + boxes.begin[list], begin + boxes.begin[list + 1]};
    }

    std::size_t longestList() const {
        std::size_t longest = 0;
        for (std::size_t list = 0; list < boxes.listOfAll(); ++list)
            longest = std::max<std::size_t>(longest, boxes.begin[list + 1] - boxes.begin[list]);
        return longest;
    }
};

/// Whether the shadow of a box, with edges of a width, reaches a point: the distance to the outline as
/// light_visibility.cpp derives it.
/// @param point  relative to the eye
bool isShaded(const Grid& grid, const BoxObstacle& box, glm::vec3 point, double width) {
    const glm::dvec3 toLight(grid.light.toLight);
    glm::dvec3 near, far, inverse;
    for (int axis = 0; axis < 3; ++axis) {
        inverse[axis] = 1.0 / (std::abs(toLight[axis]) > 1.0e-6 ? toLight[axis] : 1.0e-6);
        const double from = double(grid.eye[axis]) + double(point[axis]);
        const double low = (double(box.minimum[axis]) - from) * inverse[axis];
        const double high = (double(box.maximum[axis]) - from) * inverse[axis];
        near[axis] = std::min(low, high);
        far[axis] = std::max(low, high);
    }
    double inside = 1.0e300;
    for (int in = 0; in < 3; ++in)
        for (int out = 0; out < 3; ++out)
            if (in != out) inside = std::min(inside, (far[out] - near[in]) / std::hypot(inverse[in], inverse[out]));
    return std::min({far.x, far.y, far.z}) > 0.0 && inside > -0.5 * width;
}

}  // namespace

TEST_CASE("Hundreds of boxes are drawn as by the oracle") {
    const By by = GENERATE(from_range(renderers()));
    CAPTURE(by);
    for (const auto projection : {render::Projection::perspective, render::Projection::orthographic}) {
        render::View view = viewOf(randomBoxes(300));
        view.light.shadows = false;
        view.camera.projection = projection;
        view.camera.halfHeight = 2.5F;
        const Difference difference = differenceOf(by, view, 1);
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
    const Difference difference = differenceOf(by, view, 1);
    INFO(difference);
    CHECK(difference.share <= 10.0 / kPixels);  // on outlines, as above
}

TEST_CASE("The soft shadows of hundreds of boxes are the oracle's, from above and at a grazing angle") {
    const By by = GENERATE(from_range(renderers()));
    CAPTURE(by);
    for (const glm::vec3 toLight : {glm::vec3(0.5F, 0.8F, 0.3F), glm::vec3(0.0F, 1.0F, 0.0F),
                                    glm::vec3(0.9F, 0.06F, -0.3F), glm::vec3(1.0F, 0.0F, 0.0F)}) {
        for (const bool isCity : {true, false}) {
            render::View view = viewOf(isCity ? city(18) : randomBoxes(300));
            view.light.toLight = glm::normalize(toLight);
            view.light.softness = 1.0F;
            CAPTURE(toLight.x, toLight.y, toLight.z, isCity);
            const Difference difference = differenceOf(by, view, 2);
            INFO(difference);
            // Where a box touches the surface, and the edge is narrower than a pixel, it is a pixel wide here and sharp
            // in the oracle.
            CHECK(difference.share < 0.05);  // counted once: 0.046 under the light from above, less under the others
            CHECK(difference.mean < 1.0);    // 0.75 there
        }
    }
}

TEST_CASE("A point's list of boxes has all whose shadows reach it") {
    for (const glm::vec3 toLight :
         {glm::vec3(0.5F, 0.8F, 0.3F), glm::vec3(0.0F, 1.0F, 0.0F), glm::vec3(-1.0F, 0.0F, 0.0F),
          glm::vec3(0.9F, 0.02F, -0.3F), glm::vec3(1e-4F, 1.0F, -1e-5F)}) {
        for (const float softWidth : {0.0F, 0.4F}) {
            std::vector<BoxObstacle> boxes = randomBoxes(300);
            boxes.push_back({{-50.0F, -1.0F, -50.0F}, {50.0F, -0.5F, 50.0F}});  // a floor
            boxes.push_back({{700.0F, 900.0F, 500.0F}, {710.0F, 940.0F, 540.0F}});
            const Grid grid(boxes, toLight, softWidth);
            REQUIRE(grid.boxes.columns * grid.boxes.rows > 20);
            Random random(11);
            int shaded = 0;
            int missing = 0;
            for (int k = 0; k < 5000; ++k) {
                const float half = k % 3 == 0 ? 40.0F : 4.0F;
                const glm::vec3 at = random.pointWithin({-half, -0.5F, -half}, {half, 2.5F, half}) - grid.eye;
                // The width of a pixel, and of the soft edge where that is wider.
                const float pixel = random.between(0.0F, 1.0F) * grid.boxes.widestPixel;
                const std::vector<std::uint32_t> list = grid.listAt(at);
                for (std::uint32_t box = 0; box < boxes.size(); ++box) {
                    if (!isShaded(grid, boxes[box], at, double(std::max(pixel, softWidth)))) continue;
                    ++shaded;
                    missing += std::find(list.begin(), list.end(), box) == list.end() ? 1 : 0;
                }
                REQUIRE(std::is_sorted(list.begin(), list.end()));
            }
            CAPTURE(toLight.x, toLight.y, toLight.z, softWidth);
            CHECK(shaded > 150);
            CHECK(missing == 0);
        }
    }
}

TEST_CASE("Boxes cover the light as much together as one by one, at any width of a pixel") {
    const std::vector<BoxObstacle> boxes = randomBoxes(300);
    for (const glm::vec3 toLight : {glm::vec3(0.5F, 0.8F, 0.3F), glm::vec3(0.9F, 0.05F, -0.3F)}) {
        for (const float softness : {0.0F, 1.0F}) {
            const Grid grid(boxes, toLight, 0.2F * softness);
            render::ShadingGeometry geometry;
            geometry.frame = render::cameraFrame(cloud(0).camera, {1280, 720});
            // A tile of points that face the light. The width of a pixel is set by their depths, whatever their places.
            Random random(23);
            render::ShadingPoints points{};
            points.count = render::kTilePixels;
            for (std::size_t k = 0; k < points.count; ++k) {
                const glm::vec3 at = random.pointWithin({-4.0F, -0.5F, -4.0F}, {4.0F, 2.0F, 4.0F}) - grid.eye;
                const float pixels = std::exp2(random.between(-8.0F, 4.0F));  // in widths of the lists' widest pixel
                points.depth[k] = pixels * grid.boxes.widestPixel / geometry.frame.pixelWidth();
                points.hitId[k] = render::kHitGround;
                for (int axis = 0; axis < 3; ++axis) {
                    points.position[static_cast<std::size_t>(axis)][k] = at[axis];
                    points.normal[static_cast<std::size_t>(axis)][k] = grid.light.toLight[axis];
                }
            }
            const auto lightOf = [&](const render::LightBoxGrid& lists, std::span<const BoxObstacle> some) {
                render::Occluders occluders;
                occluders.light = grid.light;
                occluders.eye = grid.eye;
                occluders.lightBoxes = &lists;
                occluders.boxes = some;
                occluders.softness = softness;
                occluders.meanRadius = 0.2F;
                render::LightVisibility visibility;
                computeLightVisibility(occluders, geometry, points, visibility);
                return visibility.light;
            };
            const auto together = lightOf(grid.boxes, boxes);
            std::vector<double> covered(points.count, 0.0);
            for (const BoxObstacle& box : boxes) {
                const auto alone = lightOf(Grid({box}, toLight, 0.2F * softness).boxes, std::span(&box, 1));
                for (std::size_t k = 0; k < points.count; ++k) covered[k] += 1.0 - double(alone[k]);
            }
            double worst = 0.0;
            int partly = 0;
            for (std::size_t k = 0; k < points.count; ++k) {
                const double expected = std::max(1.0 - covered[k], 0.0);
                worst = std::max(worst, std::abs(double(together[k]) - expected));
                partly += expected > 0.01 && expected < 0.99 ? 1 : 0;
            }
            CAPTURE(toLight.y, softness, partly);
            CHECK(partly > 10);
            CHECK(worst < 300 * 1.2e-7);  // each coverage and each sum is rounded
        }
    }
}

TEST_CASE("Lists of boxes stay short, also beside strays and over a vast floor") {
    std::vector<BoxObstacle> boxes = city(40);
    const Grid alone(boxes, {0.5F, 0.8F, 0.3F}, 0.0F);
    CHECK(alone.longestList() < 60);  // of 1600; counted once: 49
    CHECK(alone.boxes.boxes.index.size() < 32 * boxes.size());
    boxes.push_back({{-1e5F, -1.0F, -1e5F}, {1e5F, -0.5F, 1e5F}});
    boxes.push_back({{1e6F, 2e6F, 1e6F}, {1.001e6F, 2.001e6F, 1.001e6F}});
    boxes.push_back({{-1e7F, 2.0F, 1.0F}, {-0.9e7F, 3.0F, 2.0F}});
    const Grid strewn(boxes, {0.5F, 0.8F, 0.3F}, 0.0F);
    CHECK(strewn.longestList() < alone.longestList() + 10);
    CHECK(strewn.boxes.boxes.index.size() < 64 * boxes.size());
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
    const Difference difference = differenceOf(by, view, 2);
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
            render::View view = viewOf(city(20));
            view.style = style;
            view.light.softness = softness;
            view.edges.push_back({{-2.0F, 0.5F, -2.0F}, {2.0F, 0.5F, 2.0F}});
            const Difference difference =
                compare(drawn(By::openGl, view, kSize, Quality::draft), drawn(By::cpu, view, kSize, Quality::draft), 1);
            INFO("style " << int(style) << ", softness " << softness << ": " << difference);
            CHECK(difference.share <= (style == render::Style::spheres ? 2.0 : 12.0) / kPixels);
        }
    }
}
#endif
