// Spheres' grid, metaballs' map and boxes' corners on the light's plane; the map of openness on the ground.
#include "render/cpu/lighting/occluder_bounds.h"

#include <limits>

namespace render {

namespace {

struct Cover {
    glm::vec2 low{std::numeric_limits<float>::max()};
    glm::vec2 high{std::numeric_limits<float>::lowest()};

    void add(glm::vec2 first, glm::vec2 last) {
        low = min(low, first);
        high = max(high, last);
    }
};

Cover shadowsOf(const View& view, const Occluders& occluders) {
    Cover cover;
    const LightGrid& grid = occluders.spheres;
    if (!grid.empty()) cover.add(grid.origin, grid.origin + grid.cellSize * glm::vec2(grid.columns, grid.rows));
    const DepthMap& map = occluders.field;
    // A texel more on each side: the map may be shifted.
    if (!map.empty())
        cover.add(map.origin - map.texelSize, map.origin + map.texelSize * glm::vec2(map.columns + 1, map.rows + 1));
    for (const BoxObstacle& box : view.boxObstacles) {
        // Half the width of an edge: a soft one's, or a pixel's, which far away is wider than anything.
        const glm::vec3 size = box.maximum - box.minimum;
        const float edge = view.light.softness * occluders.meanRadius + 0.5F * length(size);
        for (int corner = 0; corner < 8; ++corner) {
            const glm::vec3 at = box.minimum + size * glm::vec3(corner & 1, (corner >> 1) & 1, corner >> 2);
            const glm::vec2 on(occluders.light.toLightSpace(at - view.camera.eye));
            cover.add(on - edge, on + edge);
        }
    }
    return cover;
}

}  // namespace

OccluderBounds occluderBoundsOf(const View& view, const Occluders& occluders) {
    OccluderBounds occluderBounds;
    occluderBounds.light = occluders.light;
    if (view.light.shadows) {
        const Cover cover = shadowsOf(view, occluders);
        occluderBounds.shadowLow = cover.low;
        occluderBounds.shadowHigh = cover.high;
    }
    if (occluders.open != nullptr && view.ambient.occlusion > 0.0F) {
        const SkyVisibilityMap& map = *occluders.open;
        occluderBounds.skyMapLow = map.origin - glm::vec2(view.camera.eye.x, view.camera.eye.z);
        occluderBounds.skyMapHigh = occluderBounds.skyMapLow + map.side * glm::vec2(map.columns, map.rows);
    }
    return occluderBounds;
}

}  // namespace render
