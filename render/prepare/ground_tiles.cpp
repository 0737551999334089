// The ground fills one side of a straight line of the picture. What a tile shows of it is the convex hull of the points
// on the ground that its four corners show.
#include "render/prepare/ground_tiles.h"

#include <algorithm>
#include <array>
#include <limits>

#include "render/prepare/tiles.h"

namespace render {

namespace {

/// The point of the ground that a corner of a tile shows.
struct Corner {
    float depth = std::numeric_limits<float>::infinity();  // view depth; infinite if the corner shows no ground
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

struct Bounds {
    glm::vec2 low{std::numeric_limits<float>::max()};
    glm::vec2 high{std::numeric_limits<float>::lowest()};

    void add(glm::vec2 point) {
        low = min(low, point);
        high = max(high, point);
    }
    bool overlaps(glm::vec2 otherLow, glm::vec2 otherHigh) const {
        // Wider by the rounding of single precision far from the eye.
        const glm::vec2 slack = 1e-4F * (max(abs(low), abs(high)) + 1.0F);
        return otherLow.x <= otherHigh.x && all(lessThanEqual(low - slack, otherHigh)) &&
               all(greaterThanEqual(high + slack, otherLow));
    }
};

GroundKind kindOf(const std::array<Corner, 4>& corners, const OccluderBounds& bounds) {
    int groundCount = 0;
    Bounds onLight;
    Bounds onGround;
    for (const Corner& corner : corners) {
        groundCount += corner.isGround() ? 1 : 0;
        onLight.add(glm::vec2(bounds.light.toLightSpace(corner.position)));
        onGround.add({corner.position.x, corner.position.z});
    }
    if (groundCount == 0) return GroundKind::none;
    // The ground in the tile extends to infinity.
    if (groundCount < 4) return GroundKind::horizon;
    const bool occluded =
        onLight.overlaps(bounds.shadowLow, bounds.shadowHigh) || onGround.overlaps(bounds.skyMapLow, bounds.skyMapHigh);
    return occluded ? GroundKind::occluded : GroundKind::plain;
}

GroundTile groundTile(const std::array<Corner, 4>& corners, const OccluderBounds& bounds, bool perspective) {
    const GroundKind kind = kindOf(corners, bounds);
    // In parallel projection rays begin on the eye's plane, and the ground may cut it.
    if (kind == GroundKind::horizon && !perspective) return {kind, 0.0F};
    // On the picture the inverse depth is linear in perspective, the depth in parallel projection: the least is at a
    // corner.
    const auto isNearer = [](const Corner& a, const Corner& b) { return a.depth < b.depth; };
    return {kind, std::ranges::min(corners, isNearer).depth};
}

}  // namespace

std::vector<GroundTile> groundTiles(const CameraFrame& frame, float height, const OccluderBounds& bounds) {
    const int columns = (frame.width + kTileSize - 1) / kTileSize;
    const int rows = (frame.height + kTileSize - 1) / kTileSize;
    std::vector<Corner> corners;
    // All samples of a pixel lie within half a pixel of its center, and so within the corners of its tile.
    for (int row = 0; row <= rows; ++row)
        for (int column = 0; column <= columns; ++column)
            corners.push_back(cornerAt(frame, height, column * kTileSize, row * kTileSize));
    std::vector<GroundTile> tiles;
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column) {
            const auto first = static_cast<std::size_t>(row * (columns + 1) + column);
            const std::size_t below = first + static_cast<std::size_t>(columns) + 1;
            tiles.push_back(groundTile({corners[first], corners[first + 1], corners[below], corners[below + 1]}, bounds,
                                       frame.perspective));
        }
    }
    return tiles;
}

}  // namespace render
