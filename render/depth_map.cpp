// The light as a camera in parallel projection, and a ray for each texel.
#include "render/depth_map.h"

#include <algorithm>
#include <limits>

#include <tbb/parallel_for.h>

#include "render/ray_places.h"

namespace render {

namespace {

CameraFrame lightFrame(const LightBasis& basis, const DepthMap& map, float top) {
    CameraFrame frame;
    frame.perspective = false;
    frame.right = basis.u;
    frame.up = -basis.v;  // rows of the map run along +v
    frame.forward = -basis.toLight;
    frame.width = map.columns;
    frame.height = map.rows;
    frame.halfWidth = 0.5F * static_cast<float>(map.columns) * map.texelSize;
    frame.halfHeight = 0.5F * static_cast<float>(map.rows) * map.texelSize;
    frame.eye =
        (map.origin.x + frame.halfWidth) * basis.u + (map.origin.y + frame.halfHeight) * basis.v + top * basis.toLight;
    return frame;
}

// Finer than a twelfth of a radius nothing more is to be seen in a shadow (measured by eye).
constexpr float kTexelsPerRadius = 12.0F;

// eye: of the camera in light space. Texels lie at multiples of their size in the world, so that a map that grows by a
// row, or a camera that moves, leaves the rest where it was.
DepthMap emptyMap(const LightBounds& bounds, glm::vec3 eye, float texelSize, int mostTexels) {
    DepthMap map;
    const glm::vec3 extent = bounds.high - bounds.low;
    map.texelSize = std::max(std::max(extent.x, extent.y) / static_cast<float>(mostTexels - 5), texelSize);
    // Two texels of margin for the filter.
    map.columns = static_cast<int>(extent.x / map.texelSize) + 6;
    map.rows = static_cast<int>(extent.y / map.texelSize) + 6;
    const glm::vec2 low = glm::vec2(bounds.low) + glm::vec2(eye);
    map.origin = (glm::floor(low / map.texelSize) - 2.0F) * map.texelSize - glm::vec2(eye);
    map.heights.assign(static_cast<std::size_t>(map.columns) * static_cast<std::size_t>(map.rows) + 1, kNoHeight);
    return map;
}

}  // namespace

DepthMap castDepthMap(const LightBasis& basis, const Skinned& skin, const DepthMapSampling& sampling) {
    const View& view = skin.view;
    DepthMap map;
    std::vector<ViewSphere> reaches;
    float smallest = std::numeric_limits<float>::max();
    double sum = 0.0;
    for (std::size_t k = 0; k < skin.balls.size(); ++k) {
        const float radius = view.particles[k].radius;
        if (radius <= 0.0F) continue;
        reaches.push_back({skin.balls[k].center - view.camera.eye, view.field.reach * radius});
        smallest = std::min(smallest, radius);
        sum += double(radius);
    }
    map.heights.assign(1, kNoHeight);
    if (reaches.empty()) return map;
    const LightBounds bounds = lightBounds(basis, reaches);
    // A soft edge is three texels of half the softness wide.
    const auto mean = static_cast<float>(sum / static_cast<double>(reaches.size()));
    const float soft = view.light.softness;
    map = emptyMap(bounds, basis.toLightSpace(view.camera.eye),
                   soft > 0.0F ? 0.5F * soft * mean : smallest / kTexelsPerRadius, sampling.mostTexels);
    map.origin += sampling.shift * map.texelSize;
    CameraFrame frame = lightFrame(basis, map, bounds.high.z);
    frame.eye += view.camera.eye;

    const BinnedField field = binField(frame, skin);
    const FieldCast cast = fieldCast(frame, view, field);
    tbb::parallel_for(std::size_t{0}, field.tiles.begin.size() - 1, [&](std::size_t tile) {
        if (field.tiles.begin[tile + 1] == field.tiles.begin[tile]) return;
        RayBlock block;
        placeRays(block, cornerOf(field.tiles, tile), kZCurve, glm::vec2(0.0F));
        castBlock(cast, tile, block);
        for (std::size_t k = 0; k < kBlockRays; ++k) {
            const int x = static_cast<int>(block.x[k]);
            const int y = static_cast<int>(block.y[k]);
            if (x >= map.columns || y >= map.rows || block.depth[k] < 0.0F) continue;
            const auto place =
                static_cast<std::size_t>(y) * static_cast<std::size_t>(map.columns) + static_cast<std::size_t>(x);
            map.heights[place] = bounds.high.z - block.depth[k];
        }
    });
    return map;
}

}  // namespace render
