// The horizon is a straight line of the picture, and the ground that a tile shows is the convex hull of the points
// where rays through the tile's corners meet it.
#include "render/prepare/ground_tiles.h"

#include <algorithm>
#include <array>
#include <optional>

namespace render {

namespace {

using Rectangle = Bounds<glm::vec2>;

/// Whether two rectangles overlap or are at most `slack` apart.
bool overlap(const Rectangle& a, const Rectangle& b, float slack) {
    return b.low.x <= b.high.x && all(lessThanEqual(a.low - slack, b.high)) &&
           all(greaterThanEqual(a.high + slack, b.low));
}

/// Bounds of all shadows on the light's plane, soft edges included.
Rectangle shadowBounds(const PreparedView& prepared) {
    const View& view = *prepared.view;
    Rectangle bounds;
    if (const LightGrid& grid = prepared.lightGrid; !grid.empty())
        bounds.add(grid.origin, grid.origin + grid.cellSize * glm::vec2(grid.columns, grid.rows));
    // The depth map of metaballs may be shifted by less than a texel: one more is added on each side.
    for (const DepthMapGrid* map : {&prepared.depthMap, &prepared.meshDepthMap})
        if (!map->empty())
            bounds.add(map->origin - map->texelSize,
                       map->origin + map->texelSize * glm::vec2(map->columns + 1, map->rows + 1));
    if (!view.light.shadows) return bounds;
    for (const BoxObstacle& box : view.boxObstacles) {
        // More than half the width of the shadow's edge, which is soft or as wide as a pixel. Half the box's diagonal
        // is enough for a pixel, because a box far away that is smaller than a pixel has no visible shadow.
        const glm::vec3 size = box.maximum - box.minimum;
        const float edge = view.light.softness * prepared.meanRadius + 0.5F * length(size);
        for (int corner = 0; corner < 8; ++corner) {
            const glm::vec3 at = box.minimum + size * glm::vec3(corner & 1, (corner >> 1) & 1, corner >> 2);
            const glm::vec2 onPlane(prepared.light.toLightSpace(at - prepared.frame.eye));
            bounds.add(onPlane - edge, onPlane + edge);
        }
    }
    return bounds;
}

/// Bounds of the ground that particles occlude or light, x and z relative to the eye.
Rectangle particleBounds(const PreparedView& prepared) {
    Rectangle bounds;
    if (const GlowGrid& grid = prepared.glowGrid; !grid.empty()) {
        const glm::vec3 low = grid.origin - prepared.frame.eye;
        const glm::vec3 high = low + grid.side * glm::vec3(grid.cells);
        bounds.add({low.x, low.z}, {high.x, high.z});
    }
    if (!prepared.hasOcclusion()) return bounds;
    const SkyVisibilityMap& map = prepared.groundSky;
    const glm::vec2 low = map.origin - glm::vec2(prepared.frame.eye.x, prepared.frame.eye.z);
    bounds.add(low, low + map.side * glm::vec2(map.columns, map.rows));
    return bounds;
}

/// The point of the ground, relative to the eye, that the ray through a corner of a tile meets; nothing if the corner
/// lies above the horizon.
using Corner = std::optional<glm::vec3>;

Corner cornerAt(const CameraFrame& frame, float height, int x, int y) {
    const float across =
        (2.0F * static_cast<float>(x) / static_cast<float>(frame.width) - 1.0F) * frame.halfWidth + frame.middle.x;
    const float above =
        (1.0F - 2.0F * static_cast<float>(y) / static_cast<float>(frame.height)) * frame.halfHeight + frame.middle.y;
    const glm::vec3 off = across * frame.right + above * frame.up;
    const glm::vec3 origin = frame.perspective ? glm::vec3(0.0F) : off;
    const glm::vec3 direction = frame.perspective ? frame.forward + off : frame.forward;
    const float depth = (height - origin.y) / direction.y;
    if (!(depth > 0.0F && depth < 1e30F)) return std::nullopt;
    return origin + depth * direction;
}

/// The kind of a tile with these corners where nothing stands before the ground.
/// @param shadows    bounds of all shadows on the light's plane
/// @param particles  bounds of the ground that particles occlude or light
TileKind kindOf(const std::array<Corner, 4>& corners, const LightBasis& light, const Rectangle& shadows,
                const Rectangle& particles) {
    const auto groundCorners = std::ranges::count_if(corners, [](const Corner& corner) { return corner.has_value(); });
    if (groundCorners == 0) return TileKind::background;
    if (groundCorners < 4) return TileKind::mixed;
    Rectangle onLightPlane;
    Rectangle onGround;
    float slack = 0.0F;  // far away single precision is coarse
    for (const Corner& corner : corners) {
        slack = std::max(slack, 1e-4F * length(*corner));
        onLightPlane.add(glm::vec2(light.toLightSpace(*corner)));
        onGround.add({corner->x, corner->z});
    }
    const bool isOccluded = overlap(onLightPlane, shadows, slack) || overlap(onGround, particles, slack);
    return isOccluded ? TileKind::occludedGround : TileKind::openGround;
}

}  // namespace

std::vector<TileKind> groundTiles(const PreparedView& view) {
    const CameraFrame& frame = view.frame;
    const float height = *view.groundHeight();
    const Rectangle shadows = shadowBounds(view);
    const Rectangle particles = particleBounds(view);
    const int columns = tilesAlong(frame.width);
    const int rows = tilesAlong(frame.height);
    std::vector<Corner> corners;
    // Samples lie at most half a pixel from the middle of their pixel, and therefore between the tile's corners.
    for (int row = 0; row <= rows; ++row)
        for (int column = 0; column <= columns; ++column)
            corners.push_back(cornerAt(frame, height, column * kTileSize, row * kTileSize));
    std::vector<TileKind> tiles;
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column) {
            const auto first = static_cast<std::size_t>(row * (columns + 1) + column);
            const std::size_t below = first + static_cast<std::size_t>(columns) + 1;
            tiles.push_back(kindOf({corners[first], corners[first + 1], corners[below], corners[below + 1]}, view.light,
                                   shadows, particles));
        }
    }
    return tiles;
}

}  // namespace render
