// Boxes that touch or overlap cast the shadow of what they fill together: every point of it counts once.
#include "tests/catch.h"

#include <cmath>
#include <random>
#include <vector>

#include "render/prepare/lighting/shadow_boxes.h"
#include "tests/render/pictures.h"

using namespace pictures;
using render::BoxObstacle;

namespace {

bool isInside(const BoxObstacle& box, glm::vec3 point) {
    return all(lessThan(box.minimum, point)) && all(lessThan(point, box.maximum));
}

/// Boxes with corners at whole numbers from 0 to 5, so that many touch.
std::vector<BoxObstacle> wholeBoxes(int count, unsigned seed) {
    std::mt19937 random(seed);
    std::vector<BoxObstacle> boxes;
    for (int k = 0; k < count; ++k) {
        BoxObstacle box;
        for (int axis = 0; axis < 3; ++axis) {
            box.minimum[axis] = static_cast<float>(random() % 5);
            box.maximum[axis] = box.minimum[axis] + 1.0F + static_cast<float>(random() % 2);
        }
        boxes.push_back(box);
    }
    return boxes;
}

/// A frame of four walls, of which two stand between the other two.
std::vector<BoxObstacle> pan() {
    const glm::vec3 color(0.3F);
    return {{{-1.4F, 0.0F, -1.0F}, {1.4F, 0.7F, -0.8F}, color},
            {{-1.4F, 0.0F, 0.8F}, {1.4F, 0.7F, 1.0F}, color},
            {{-1.4F, 0.0F, -0.8F}, {-1.2F, 0.7F, 0.8F}, color},
            {{1.2F, 0.0F, -0.8F}, {1.4F, 0.7F, 0.8F}, color}};
}

}  // namespace

TEST_CASE("What boxes fill together counts once, and all else not at all") {
    for (unsigned seed = 0; seed < 40; ++seed) {
        const std::vector<BoxObstacle> boxes = wholeBoxes(2 + static_cast<int>(seed % 7), seed);
        const render::ShadowBoxes joined = render::shadowBoxes(boxes);
        for (int k = 0; k < 8 * 8 * 8; ++k) {
            const glm::vec3 point = glm::vec3(k % 8, k / 8 % 8, k / 64) - 0.5F;
            int count = 0;
            for (std::size_t b = 0; b < joined.boxes.size(); ++b)
                if (isInside(joined.boxes[b], point)) count += b < joined.subtractedCount ? -1 : 1;
            bool isFilled = false;
            for (const BoxObstacle& box : boxes) isFilled = isFilled || isInside(box, point);
            INFO("seed " << seed << ", point " << point.x << " " << point.y << " " << point.z);
            REQUIRE(count == (isFilled ? 1 : 0));
        }
    }
}

TEST_CASE("Boxes in a row become one, a frame four with four corners, and boxes apart stay as they are") {
    const std::vector<BoxObstacle> row = {
        {{0, 0, 0}, {1, 1, 1}, {}}, {{2, 0, 0}, {3, 1, 1}, {}}, {{1, 0, 0}, {2, 1, 1}, {}}};
    const render::ShadowBoxes joined = render::shadowBoxes(row);
    REQUIRE(joined.boxes.size() == 1);
    CHECK(joined.subtractedCount == 0);
    CHECK(joined.boxes[0].minimum == glm::vec3(0.0F));
    CHECK(joined.boxes[0].maximum == glm::vec3(3.0F, 1.0F, 1.0F));

    CHECK(render::shadowBoxes(pan()).boxes.size() == 8);
    CHECK(render::shadowBoxes(pan()).subtractedCount == 4);

    const std::vector<BoxObstacle> apart = {{{0, 0, 0}, {1, 1, 1}, {}}, {{1.5F, 0, 0}, {3, 1, 1}, {}}};
    const render::ShadowBoxes same = render::shadowBoxes(apart);
    REQUIRE(same.boxes.size() == 2);
    for (std::size_t k = 0; k < 2; ++k) CHECK(same.boxes[k].minimum == apart[k].minimum);
}

TEST_CASE("So many boxes within each other that joining them would take long are left as they are") {
    std::vector<BoxObstacle> crossed;
    for (int k = 0; k < 12; ++k) {  // 4095 intersections
        const float far = 20.0F - static_cast<float>(k);
        const float near = 1.0F + 0.01F * static_cast<float>(k);
        crossed.push_back({{-far, -near, -1.0F}, {near, far, 1.0F}, {}});
    }
    CHECK(render::shadowBoxes(crossed).boxes.size() == crossed.size());
    CHECK(render::shadowBoxes({}).boxes.empty());
}

TEST_CASE("The soft shadow of walls that meet has no spur") {
    const By by = GENERATE(from_range(renderers()));
    CAPTURE(by);
    render::View view = cloud(1);
    view.particles.front() = {{0.0F, 0.1F, 0.0F}, 0.1F, {0.5F, 0.5F, 0.5F}};
    view.light.shadows = true;
    view.light.softness = 1.0F;
    view.light.toLight = {-0.55F, 0.75F, 0.4F};
    view.boxObstacles = {{{-1.4F, 0.0F, -1.0F}, {1.4F, 0.7F, 1.0F}, glm::vec3(0.3F)}};
    // A block of one box, and the same block of two.
    const render::Image whole = drawn(by, view, {121, 75}, render::Quality::draft);
    view.boxObstacles = {{{-1.4F, 0.0F, -1.0F}, {1.4F, 0.7F, 0.3F}, glm::vec3(0.3F)},
                         {{-1.4F, 0.0F, 0.3F}, {1.4F, 0.7F, 1.0F}, glm::vec3(0.3F)}};
    CHECK(drawn(by, view, {121, 75}, render::Quality::draft).rgb == whole.rgb);

    view.boxObstacles = pan();
    const Difference difference = differenceFromOracle(by, view, {121, 75}, 2);
    INFO(difference);
    // Where an occluder touches the surface, the edge is a pixel wide here and sharp in the oracle.
    CHECK(difference.share < 0.005);
}
