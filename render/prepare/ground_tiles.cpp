// The ground is seen below a straight line of the picture, and a tile's piece of it is the hull of what its corners
// show.
#include "render/prepare/ground_tiles.h"

#include <algorithm>
#include <array>
#include <limits>

#include "render/prepare/tiles.h"

namespace render {

namespace {

struct Corner {
    float depth = std::numeric_limits<float>::infinity();  // in view, of the ground
    glm::vec3 place{0.0F};                                 // there, relative to the eye

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
        // A little more than touching: single precision far away.
        const glm::vec2 slack = 1e-4F * (max(abs(low), abs(high)) + 1.0F);
        return otherLow.x <= otherHigh.x && all(lessThanEqual(low - slack, otherHigh)) &&
               all(greaterThanEqual(high + slack, otherLow));
    }
};

GroundKind kindOf(const std::array<Corner, 4>& corners, const OccluderBounds& occluderBounds) {
    int seen = 0;
    Bounds onLight;
    Bounds onGround;
    for (const Corner& corner : corners) {
        seen += corner.isGround() ? 1 : 0;
        onLight.add(glm::vec2(occluderBounds.light.toLightSpace(corner.place)));
        onGround.add({corner.place.x, corner.place.z});
    }
    if (seen == 0) return GroundKind::none;
    // Its piece has no end.
    if (seen < 4) return GroundKind::horizon;
    const bool occluded = onLight.overlaps(occluderBounds.shadowLow, occluderBounds.shadowHigh) ||
                          onGround.overlaps(occluderBounds.skyMapLow, occluderBounds.skyMapHigh);
    return occluded ? GroundKind::occluded : GroundKind::plain;
}

GroundTile groundTile(const std::array<Corner, 4>& corners, const OccluderBounds& occluderBounds, bool perspective) {
    const GroundKind kind = kindOf(corners, occluderBounds);
    // In parallel projection the ground comes up to the rays' beginnings.
    if (kind == GroundKind::horizon && !perspective) return {kind, 0.0F};
    // The inverse of the depth, or the depth itself, is linear on the picture: the depth is least at a corner.
    const auto isNearer = [](const Corner& a, const Corner& b) { return a.depth < b.depth; };
    return {kind, std::ranges::min(corners, isNearer).depth};
}

}  // namespace

std::vector<GroundTile> groundTiles(const CameraFrame& frame, float height, const OccluderBounds& occluderBounds) {
    const int columns = (frame.width + kTileSize - 1) / kTileSize;
    const int rows = (frame.height + kTileSize - 1) / kTileSize;
    std::vector<Corner> corners;
    // Samples of the last pixels reach half a pixel beyond their middle, within the tile's corners.
    for (int row = 0; row <= rows; ++row)
        for (int column = 0; column <= columns; ++column)
            corners.push_back(cornerAt(frame, height, column * kTileSize, row * kTileSize));
    std::vector<GroundTile> tiles;
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column) {
            const auto first = static_cast<std::size_t>(row * (columns + 1) + column);
            const std::size_t below = first + static_cast<std::size_t>(columns) + 1;
            tiles.push_back(groundTile({corners[first], corners[first + 1], corners[below], corners[below + 1]},
                                       occluderBounds, frame.perspective));
        }
    }
    return tiles;
}

}  // namespace render
