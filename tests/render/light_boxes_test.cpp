// The lists of boxes by cells of the light's plane: they have all boxes that may shade a point, and few others.
#include "tests/catch.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "render/cpu/lighting/light_visibility.h"
#include "render/prepare/lighting/light_space.h"
#include "tests/render/many_boxes.h"

using namespace pictures;
using render::BoxObstacle;

namespace {

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
/// box_shadows-inl.h derives it.
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
