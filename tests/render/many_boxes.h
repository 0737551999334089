// Hundreds of boxes, for the tests of the renderers.
#pragma once

#include <random>
#include <utility>
#include <vector>

#include "tests/render/pictures.h"

namespace pictures {

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
inline std::vector<render::BoxObstacle> randomBoxes(int count) {
    Random random(3);
    std::vector<render::BoxObstacle> boxes;
    for (int k = 0; k < count; ++k) {
        const glm::vec3 at = random.pointWithin({-3.0F, -0.1F, -3.0F}, {3.0F, 2.0F, 3.0F});
        const float scale = random.between(0.02F, k % 20 == 0 ? 1.0F : 0.3F);
        const glm::vec3 size = scale * random.pointWithin(glm::vec3(0.2F), glm::vec3(1.0F));
        boxes.push_back({at, at + size, random.pointWithin(glm::vec3(0.1F), glm::vec3(0.9F))});
    }
    return boxes;
}

/// Blocks of different heights in a square of streets.
inline std::vector<render::BoxObstacle> city(int side) {
    Random random(5);
    std::vector<render::BoxObstacle> boxes;
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
inline render::View viewOf(std::vector<render::BoxObstacle> boxes) {
    render::View view = cloud(60);
    view.boxObstacles = std::move(boxes);
    view.light.shadows = true;
    return view;
}

}  // namespace pictures
