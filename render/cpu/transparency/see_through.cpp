// The rays are followed one by one; what they show is shaded with vectors afterwards, as all points are.
#include "render/cpu/transparency/see_through.h"

#include <algorithm>
#include <cmath>

#include "render/cpu/transparency/ball_cache.h"
#include "render/cpu/transparency/light_path.h"

namespace render {

namespace {

glm::vec3 vectorAt(const TileVec3& values, std::size_t k) {
    return {values[0][k], values[1][k], values[2][k]};
}

void setVector(TileVec3& values, std::size_t k, glm::vec3 value) {
    for (int axis = 0; axis < 3; ++axis) values[static_cast<std::size_t>(axis)][k] = value[axis];
}

/// Direction of the ray through a point of the picture, along the world's axes, unit length.
glm::vec3 rayDirection(const CameraFrame& frame, float x, float y) {
    if (!frame.perspective) return frame.forward;
    const float across = (x * (2.0F / static_cast<float>(frame.width)) - 1.0F) * frame.halfWidth + frame.middle.x;
    const float upward = (1.0F - y * (2.0F / static_cast<float>(frame.height))) * frame.halfHeight + frame.middle.y;
    return normalize(frame.forward + across * frame.right + upward * frame.up);
}

/// The row of pixels, as a position, in which the eye sees a direction: that of the background behind a ray.
/// @param own  position of the ray on the picture, pixels from the top
float backgroundRow(const CameraFrame& frame, glm::vec3 direction, float own) {
    if (!frame.perspective) return own;
    const float height = static_cast<float>(frame.height);
    const float ahead = dot(direction, frame.forward);
    const float upward = dot(direction, frame.up);
    // Directions that the eye does not see, beside it or behind, count as those above or below the picture.
    if (ahead <= 0.0F) return upward > 0.0F ? 0.0F : height;
    const float above = upward - ahead * frame.middle.y;
    return std::clamp(0.5F * (1.0F - above / (ahead * frame.halfHeight)), 0.0F, 1.0F) * height;
}

/// What a transparent mesh mirrors of the light and its surroundings: the terms highlight and mirrored of
/// shading_model.h.
/// @param lightVisibility  share of the light that reaches the point
glm::vec3 mirroredByMesh(const View& view, glm::vec3 toLight, const FirstSurface& at, const Medium& medium,
                         float lightVisibility) {
    const glm::vec3 toEye = -at.direction;
    const float cosine = std::clamp(dot(at.normal, toEye), 0.0F, 1.0F);
    const glm::vec3 mirroredRay = 2.0F * dot(at.normal, toEye) * at.normal - toEye;
    const glm::vec3 mirrored =
        mirroredShare(1.0F, medium.refractiveIndex, cosine) * surroundingsToward(view.surroundings, mirroredRay);
    if (dot(at.normal, toLight) <= 0.0F) return mirrored;
    const glm::vec3 halfway = normalize(toLight + toEye);
    float peak = std::max(dot(at.normal, halfway), 0.0F);
    for (int squaring = 0; squaring < kGlassGloss; ++squaring) peak *= peak;
    constexpr auto kExponent = static_cast<float>(1 << kGlassGloss);
    const float share = mirroredShare(1.0F, medium.refractiveIndex, std::clamp(dot(toEye, halfway), 0.0F, 1.0F));
    return mirrored + view.light.color * (lightVisibility * share * (kExponent + 8.0F) / 8.0F * peak);
}

/// Sets the point that is shaded at the end of a ray.
void setEnd(const CameraFrame& frame, const ShadingPoints& points, std::size_t k, const LightPath& path,
            std::size_t end, SeenThrough& behind) {
    ShadingPoints& ends = behind.ends;
    ends.hitId[end] = path.hitId;
    ends.x[end] = points.x[k];
    ends.y[end] = backgroundRow(frame, path.direction, points.y[k]);
    ends.depth[end] = points.depth[k] + path.length;
    setVector(ends.position, end, path.position);
    setVector(ends.normal, end, path.normal);
    setVector(ends.albedo, end, path.color);
    setVector(ends.sky, end, path.sky);
    setVector(behind.endShading.direction, end, path.direction);
    behind.endShading.bodyShare[end] = 1.0F;
    setVector(behind.endShading.added, end, glm::vec3(0.0F));
}

}  // namespace

void findSeenThrough(const PreparedView& view, const ShadingGeometry& geometry, const ShadingPoints& points,
                     const LightVisibility* visibility, SeenThrough& behind) {
    thread_local BallCache cache;
    cache.prepareFor(view.fieldCells);
    behind.ends.count = 0;
    for (std::size_t k = 0; k < points.count; ++k) {
        const glm::vec3 direction = rayDirection(geometry.frame, points.x[k], points.y[k]);
        setVector(behind.shading.direction, k, direction);
        behind.shading.bodyShare[k] = 1.0F;
        setVector(behind.shading.added, k, glm::vec3(0.0F));
        const Medium* medium = mediumOf(view, points.hitId[k]);
        if (medium == nullptr) continue;
        const FirstSurface first{vectorAt(points.position, k), direction, vectorAt(points.normal, k),
                                 vectorAt(points.albedo, k), points.hitId[k]};
        const LightPath path = followRay(view, geometry, first, cache);
        glm::vec3 added = path.mirrored;
        if (first.hitId < kHitMetaballs)
            added += mirroredByMesh(*view.view, view.light.toLight, first, *medium,
                                    visibility != nullptr ? visibility->light[k] : 1.0F);
        behind.shading.bodyShare[k] = 1.0F - medium->transparency;
        setVector(behind.shading.added, k, added);
        const std::size_t end = behind.ends.count++;
        behind.point[end] = static_cast<std::uint8_t>(k);
        behind.weight[end] = medium->transparency * path.weight;
        setEnd(geometry.frame, points, k, path, end, behind);
    }
    // Whole vectors of ends are shaded; the colors beyond the last are not used.
    for (std::size_t end = behind.ends.count; end < kTilePixels && end % kTileSize != 0; ++end)
        setEnd(geometry.frame, points, 0, LightPath{}, end, behind);
}

}  // namespace render
