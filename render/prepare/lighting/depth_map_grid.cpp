// The size of a texel comes from the softness of the light or from the smallest particle.
#include "render/prepare/lighting/depth_map_grid.h"

#include <algorithm>
#include <limits>

#include "render/picture/parallel_loops.h"
#include "render/prepare/cells/mean_radius.h"

namespace render {

namespace {

// Texels per radius of the smallest particle in a map for sharp shadows. Chosen by eye: the edge of a shadow, which is
// filtered over three texels, is then a quarter of a radius wide.
constexpr float kTexelsPerRadius = 12.0F;

/// The grid around all that casts shadows.
/// @param bounds  in light space, relative to the eye, m
/// @param wanted  side of a texel if not more than maxTexels lie along a side of the map, m
DepthMapGrid gridAround(const LightBasis& basis, const View& view, const Bounds<glm::vec3>& bounds, float wanted,
                        int maxTexels) {
    const glm::vec3 extent = bounds.high - bounds.low;
    DepthMapGrid grid;
    grid.texelSize = std::max(
        {std::max(extent.x, extent.y) / static_cast<float>(maxTexels - 7), wanted, std::numeric_limits<float>::min()});
    grid.columns = static_cast<int>(extent.x / grid.texelSize) + 8;
    grid.rows = static_cast<int>(extent.y / grid.texelSize) + 8;
    const glm::vec2 eye(basis.toLightSpace(view.camera.eye));
    const glm::vec2 low = glm::vec2(bounds.low) + eye;
    grid.origin = (glm::floor(low / grid.texelSize) - 3.0F) * grid.texelSize - eye;
    grid.bottom = bounds.low.z;
    grid.top = bounds.high.z;
    return grid;
}

/// Side of a texel whose filter, three texels wide, is as wide as soft edges (shading_model.h), m.
float softTexelSize(const View& view) {
    return 0.5F * view.light.softness * static_cast<float>(meanRadius(view.particles));
}

}  // namespace

DepthMapGrid depthMapGrid(const LightBasis& basis, const View& view, std::span<const SkinBall> balls, int maxTexels) {
    Bounds<glm::vec3> bounds;  // bounds of the balls' kernels in light space, m
    float smallest = std::numeric_limits<float>::max();
    for (std::size_t k = 0; k < balls.size(); ++k) {
        const float radius = view.particles[k].radius;
        if (radius <= 0.0F) continue;
        const glm::vec3 center = basis.toLightSpace(balls[k].center - view.camera.eye);
        const glm::vec3 half = extentAlong(view, balls[k], basis.u, basis.v, basis.toLight);
        bounds.add(center - half, center + half);
        smallest = std::min(smallest, radius);
    }
    if (bounds.low.x > bounds.high.x) return {};
    const float wanted = view.light.softness > 0.0F ? softTexelSize(view) : smallest / kTexelsPerRadius;
    return gridAround(basis, view, bounds, wanted, maxTexels);
}

DepthMapGrid meshDepthMapGrid(const LightBasis& basis, const View& view, const DrawnMeshes& meshes, int maxTexels) {
    const Bounds<glm::vec3> bounds =
        boundsOfAll(meshes.positions.size(), [&](std::size_t k) { return basis.toLightSpace(meshes.positions[k]); });
    return gridAround(basis, view, bounds, softTexelSize(view), maxTexels);
}

CameraFrame lightFrame(const LightBasis& basis, const DepthMapGrid& grid, glm::vec3 eye, int pixelsPerTexel) {
    CameraFrame frame;
    frame.perspective = false;
    frame.right = basis.u;
    frame.up = -basis.v;  // the rows of the map run along +v, from top to bottom
    frame.forward = -basis.toLight;
    frame.width = grid.columns * pixelsPerTexel;
    frame.height = grid.rows * pixelsPerTexel;
    frame.halfWidth = 0.5F * static_cast<float>(grid.columns) * grid.texelSize;
    frame.halfHeight = 0.5F * static_cast<float>(grid.rows) * grid.texelSize;
    frame.eye = (grid.origin.x + frame.halfWidth) * basis.u + (grid.origin.y + frame.halfHeight) * basis.v +
                grid.top * basis.toLight;
    frame.eye += eye;
    return frame;
}

}  // namespace render
