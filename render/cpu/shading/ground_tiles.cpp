// The ground is seen below a straight line of the picture, and the ground in a tile is the hull of what rays through
// the tile's corners meet.
#include "render/cpu/shading/ground_tiles.h"

#include <algorithm>
#include <array>

namespace render {

namespace {

/// An axis-aligned rectangle; empty at first.
struct Bounds {
    glm::vec2 low{std::numeric_limits<float>::max()};
    glm::vec2 high{std::numeric_limits<float>::lowest()};

    void add(glm::vec2 first, glm::vec2 last) {
        low = min(low, first);
        high = max(high, last);
    }
    void add(glm::vec2 point) { add(point, point); }

    /// Whether it overlaps another, or almost touches it: far away single precision is coarse.
    bool overlaps(const Bounds& other) const {
        const glm::vec2 slack = 1e-4F * (max(abs(low), abs(high)) + 1.0F);
        return other.low.x <= other.high.x && all(lessThanEqual(low - slack, other.high)) &&
               all(greaterThanEqual(high + slack, other.low));
    }
};

/// Bounds of all shadows on the light's plane, soft edges included.
Bounds shadowBounds(const Occluders& occluders) {
    Bounds bounds;
    if (const LightGrid* grid = occluders.spheres)
        bounds.add(grid->origin, grid->origin + grid->cellSize * glm::vec2(grid->columns, grid->rows));
    // A texel more on each side, because the map may be shifted.
    if (const DepthMap* map = occluders.metaballs)
        bounds.add(map->origin - map->texelSize,
                   map->origin + map->texelSize * glm::vec2(map->columns + 1, map->rows + 1));
    for (const BoxObstacle& box : occluders.boxes) {
        // Half the width of an edge: of a soft one, or of a pixel, which far away is wider than anything.
        const glm::vec3 size = box.maximum - box.minimum;
        const float edge = occluders.softness * occluders.meanRadius + 0.5F * length(size);
        for (int corner = 0; corner < 8; ++corner) {
            const glm::vec3 at = box.minimum + size * glm::vec3(corner & 1, (corner >> 1) & 1, corner >> 2);
            const glm::vec2 onPlane(occluders.light.toLightSpace(at - occluders.eye));
            bounds.add(onPlane - edge, onPlane + edge);
        }
    }
    return bounds;
}

/// Bounds of the map of the ground's sky visibility, x and z relative to the eye.
Bounds skyBounds(const Occluders& occluders) {
    Bounds bounds;
    if (const SkyVisibilityMap* map = occluders.groundSky) {
        const glm::vec2 low = map->origin - glm::vec2(occluders.eye.x, occluders.eye.z);
        bounds.add(low, low + map->side * glm::vec2(map->columns, map->rows));
    }
    return bounds;
}

/// What a ray through a corner of a tile meets of the ground.
struct Corner {
    float depth = std::numeric_limits<float>::infinity();  // view depth, m; infinite above the horizon
    glm::vec3 position{0.0F};                              // relative to the eye

    bool isGround() const { return depth < std::numeric_limits<float>::infinity(); }
};

Corner cornerAt(const CameraFrame& frame, float height, int x, int y) {
    const float across = (2.0F * static_cast<float>(x) / static_cast<float>(frame.width) - 1.0F) * frame.halfWidth;
    const float above = (1.0F - 2.0F * static_cast<float>(y) / static_cast<float>(frame.height)) * frame.halfHeight;
    const glm::vec3 off = across * frame.right + above * frame.up;
    const glm::vec3 origin = frame.perspective ? glm::vec3(0.0F) : off;
    const glm::vec3 direction = frame.perspective ? frame.forward + off : frame.forward;
    const float depth = (height - origin.y) / direction.y;
    if (!(depth > 0.0F && depth < 1e30F)) return {};
    return {depth, origin + depth * direction};
}

class GroundClassifier {
 public:
    GroundClassifier(const Occluders& occluders, bool isPerspective)
        : light_(occluders.light),
          shadows_(shadowBounds(occluders)),
          sky_(skyBounds(occluders)),
          isPerspective_(isPerspective) {}

    GroundTile classify(const std::array<Corner, 4>& corners) const {
        const GroundKind kind = kindOf(corners);
        // In parallel projection the ground comes up to where the rays begin.
        if (kind == GroundKind::horizon && !isPerspective_) return {kind, 0.0F};
        // The inverse of the depth, or the depth itself, is linear on the picture: the depth is least at a corner.
        const auto isNearer = [](const Corner& a, const Corner& b) { return a.depth < b.depth; };
        return {kind, std::ranges::min(corners, isNearer).depth};
    }

 private:
    GroundKind kindOf(const std::array<Corner, 4>& corners) const {
        const auto groundCorners = std::ranges::count_if(corners, &Corner::isGround);
        if (groundCorners == 0) return GroundKind::none;
        if (groundCorners < 4) return GroundKind::horizon;
        Bounds onLightPlane;
        Bounds onGround;
        for (const Corner& corner : corners) {
            onLightPlane.add(glm::vec2(light_.toLightSpace(corner.position)));
            onGround.add({corner.position.x, corner.position.z});
        }
        return onLightPlane.overlaps(shadows_) || onGround.overlaps(sky_) ? GroundKind::occluded : GroundKind::open;
    }

    LightBasis light_;
    Bounds shadows_;
    Bounds sky_;
    bool isPerspective_;
};

}  // namespace

std::vector<GroundTile> groundTiles(const CameraFrame& frame, float height, const Occluders& occluders) {
    const GroundClassifier classifier(occluders, frame.perspective);
    const int columns = (frame.width + kTileSize - 1) / kTileSize;
    const int rows = (frame.height + kTileSize - 1) / kTileSize;
    std::vector<Corner> corners;
    // Samples reach half a pixel beyond the middle of the last pixel, which is within the tile's corners.
    for (int row = 0; row <= rows; ++row)
        for (int column = 0; column <= columns; ++column)
            corners.push_back(cornerAt(frame, height, column * kTileSize, row * kTileSize));
    std::vector<GroundTile> tiles;
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column) {
            const auto first = static_cast<std::size_t>(row * (columns + 1) + column);
            const std::size_t below = first + static_cast<std::size_t>(columns) + 1;
            tiles.push_back(
                classifier.classify({corners[first], corners[first + 1], corners[below], corners[below + 1]}));
        }
    }
    return tiles;
}

}  // namespace render
