// Most lines run along faces of boxes or meshes and over the ground. There the depth of the pixel's own ray does not
// tell whether the line is hidden, because the line may pass beside the middle of the pixel: a ray through the line's
// nearest point is cast.
#include "render/cpu/raster/lines.h"

#include <algorithm>

#include "render/cpu/raster/mesh_hits.h"

namespace render {

namespace {

// A surface hides a line if its depth is less than this share of the line's depth. Chosen: no surface but the face that
// a line lies on comes closer to the line.
constexpr float kNearer = 0.999F;

/// The point of a line that is nearest to a pixel.
struct LinePoint {
    float coverage = 0.0F;  // share of the pixel that the line covers
    float depth = 1.0F;     // view depth of the point, m
    glm::vec2 at{0.0F};     // position of the point on the picture, pixels
};

LinePoint nearestOnLine(const ScreenLine& line, bool perspective, glm::vec2 pixel) {
    const float t = closestParameter(line, pixel);
    LinePoint point;
    point.at = line.from + t * (line.to - line.from);
    // In perspective 1/depth is linear on the picture, in parallel projection the depth itself.
    point.depth = perspective ? 1.0F / glm::mix(1.0F / line.fromDepth, 1.0F / line.toDepth, t)
                              : glm::mix(line.fromDepth, line.toDepth, t);
    // A line thinner than a pixel covers no more than its width.
    point.coverage = std::clamp(0.5F * line.width + 0.5F - distance(pixel, point.at), 0.0F, std::min(line.width, 1.0F));
    return point;
}

bool isFlat(std::int32_t hitId) {
    return hitId < 0 || (hitId >= kHitTriangle && hitId < kHitMetaballs);
}

/// Share of a pixel's samples at which neither a sphere nor metaballs hide a line at this depth.
float shareInFront(std::span<const TileRays> samples, std::size_t pixel, float depth) {
    int shown = 0;
    for (const TileRays& rays : samples)
        shown += isFlat(rays.hitId[pixel]) || rays.depth[pixel] >= depth * kNearer ? 1 : 0;
    return static_cast<float>(shown) / static_cast<float>(samples.size());
}

}  // namespace

LineCoverage lineCoverage(const SolidGeometry& geometry, const LineList& lines, std::size_t tile,
                          std::span<const TileRays> samples, glm::vec2 point) {
    const glm::vec2 corner = tileCorner(lines.tiles, tile) + point;
    LineCoverage over{};
    for (const std::uint32_t index : lines.tiles.itemsOf(tile)) {
        const ScreenLine& line = lines.lines[index];
        std::array<LinePoint, kTilePixels> points;
        TileRays rays;
        for (std::size_t pixel = 0; pixel < kTilePixels; ++pixel) {
            const glm::vec2 at = corner + glm::vec2(pixel % kTileSize, pixel / kTileSize);
            points[pixel] = nearestOnLine(line, geometry.frame.perspective, at);
            rays.x[pixel] = points[pixel].at.x;
            rays.y[pixel] = points[pixel].at.y;
        }
        findFlatHits(geometry, {true, geometry.boxTiles->itemsOf(tile)}, rays);
        if (geometry.meshes != nullptr) findMeshHitsAnywhere(geometry, tile, rays);
        for (std::size_t pixel = 0; pixel < kTilePixels; ++pixel) {
            const LinePoint& nearest = points[pixel];
            if (nearest.coverage <= 0.0F || rays.depth[pixel] < nearest.depth * kNearer) continue;
            const float share = nearest.coverage * shareInFront(samples, pixel, nearest.depth);
            over[pixel] = over[pixel] * (1.0F - share) + share * glm::vec4(line.color, 1.0F);
        }
    }
    return over;
}

}  // namespace render
