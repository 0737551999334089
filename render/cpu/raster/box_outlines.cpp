// A ray passes an edge on one side or the other by the sign of a function that is linear over the picture.
#include "render/cpu/raster/box_outlines.h"

#include <algorithm>
#include <cmath>

#include "render/cpu/raster/primary_hits.h"

namespace render {

namespace {

/// The share of a pixel on the positive side of a line: the area under a trapezoid, which the widths of the pixel along
/// both axes make of the line's distance.
/// @param at     value in the middle of the pixel of a function that is linear over the picture and 0 on the line
/// @param slope  its absolute changes from pixel to pixel
float halfPlaneShare(float at, glm::vec2 slope) {
    const float total = std::max(slope.x + slope.y, 1.0e-30F);
    const float inside = std::clamp(at / total, -0.5F, 0.5F);
    const float larger = std::max(slope.x, slope.y) / total;
    const float lesser = std::min(slope.x, slope.y) / total;
    const float rest = 0.5F - std::abs(inside);
    const float share = rest >= lesser ? 0.5F + std::abs(inside) / std::max(larger, 0.5F)
                                       : 1.0F - rest * rest / (2.0F * larger * lesser);
    return inside >= 0.0F ? share : 1.0F - share;
}

/// On which side of an edge the ray through a point of the picture passes, by the sign.
/// @param corner  where the edge begins, relative to the eye, m
float rayPastEdge(const CameraFrame& frame, glm::vec2 pixel, glm::vec3 corner, glm::vec3 edge) {
    const float x = (pixel.x * (2.0F / static_cast<float>(frame.width)) - 1.0F) * frame.halfWidth + frame.middle.x;
    const float y = (1.0F - pixel.y * (2.0F / static_cast<float>(frame.height))) * frame.halfHeight + frame.middle.y;
    const glm::vec3 off = frame.right * x + frame.up * y;
    if (frame.perspective) return dot(cross(corner, edge), frame.forward + off);
    return dot(cross(corner - off, edge), frame.forward);
}

}  // namespace

float faceShare(const CameraFrame& frame, const BoxObstacle& box, int face, glm::vec2 middle) {
    const int axis = face / 2;
    const glm::vec3 size = box.maximum - box.minimum;
    glm::vec3 corner = box.minimum - frame.eye;
    if (face % 2 == 0) corner[axis] += size[axis];
    glm::vec3 sideways(0.0F);
    glm::vec3 along(0.0F);
    sideways[(axis + 1) % 3] = size[(axis + 1) % 3];
    along[(axis + 2) % 3] = size[(axis + 2) % 3];
    const glm::vec3 center = corner + 0.5F * (sideways + along);
    float share = 1.0F;
    for (const glm::vec3& edge : {sideways, along, -sideways, -along}) {
        const float ofCenter =
            frame.perspective ? dot(cross(corner, edge), center) : dot(cross(corner - center, edge), frame.forward);
        const float at = rayPastEdge(frame, middle, corner, edge);
        const glm::vec2 slope(rayPastEdge(frame, middle + glm::vec2(1.0F, 0.0F), corner, edge) - at,
                              rayPastEdge(frame, middle + glm::vec2(0.0F, 1.0F), corner, edge) - at);
        share *= halfPlaneShare(ofCenter < 0.0F ? -at : at, abs(slope));
        corner += edge;
    }
    return share;
}

std::optional<float> shareOfFirst(const CameraFrame& frame, std::span<const BoxObstacle> boxes,
                                  const std::array<SampledHit, 2>& hits, glm::vec2 middle) {
    for (std::size_t k = 0; k < hits.size(); ++k) {
        const std::int32_t id = hits[k].hitId - kHitBox;
        if (id < 0 || id >= kHitMetaballs - kHitBox || (id & 8) != 0) continue;
        const float share = faceShare(frame, boxes[static_cast<std::size_t>(id / 16)], id & 7, middle);
        const float sampled = 0.25F * static_cast<float>(hits[k].sampleCount);
        if (share > 0.0F && share < 1.0F && std::abs(share - sampled) <= 0.25F) return k == 0 ? share : 1.0F - share;
    }
    return std::nullopt;
}

}  // namespace render
