// Lines mostly run along faces of boxes and over the ground, where the depth of the pixel says nothing (the pixel is
// beside the line): there the ray through the line's own point is followed.
#include "render/cpu/raster/line_coverage.h"

#include <algorithm>

namespace render {

namespace {

// A line is hidden by what is nearer than this share of its depth: closer than anything stands to a line.
constexpr float kNearer = 0.999F;

struct LinePoint {
    float cover = 0.0F;  // share of the pixel that the line covers
    float depth = 1.0F;  // view depth of the nearest point of the line
    glm::vec2 at{0.0F};  // where that point is, in pixels
};

LinePoint nearestOnLine(const ScreenLine& line, bool perspective, glm::vec2 at) {
    const glm::vec2 from = line.from;
    const glm::vec2 along = line.to - from;
    const float part = std::clamp(dot(at - from, along) / std::max(dot(along, along), 1.0e-12F), 0.0F, 1.0F);
    LinePoint point;
    point.at = from + part * along;
    // 1/depth is linear on the picture in perspective, depth itself in parallel projection.
    point.depth = perspective ? 1.0F / glm::mix(1.0F / line.fromDepth, 1.0F / line.toDepth, part)
                              : glm::mix(line.fromDepth, line.toDepth, part);
    // A line thinner than a pixel covers no more than its width.
    const float width = line.width;
    point.cover = std::clamp(0.5F * width + 0.5F - distance(at, point.at), 0.0F, std::min(width, 1.0F));
    return point;
}

bool isFlat(std::int32_t seen) {
    return seen < 0 || (seen >= kSeesBox && seen < kSeesField);
}

// Share of the samples at a pixel that do not hide what is at this depth.
float shareInFront(std::span<const TileRays> samples, std::size_t place, float depth) {
    int shown = 0;
    for (const TileRays& rays : samples)
        shown += isFlat(rays.seen[place]) || rays.depth[place] >= depth * kNearer ? 1 : 0;
    return static_cast<float>(shown) / static_cast<float>(samples.size());
}

}  // namespace

LineCover lineCover(const Solids& solids, const LineList& lines, std::size_t tile, std::span<const TileRays> samples,
                    glm::vec2 where) {
    const glm::vec2 corner = tileCorner(lines.tiles, tile) + where;
    LineCover over{};
    for (std::size_t k = lines.tiles.begin[tile]; k < lines.tiles.begin[tile + 1]; ++k) {
        const ScreenLine& line = lines.lines[lines.tiles.items[k]];
        std::array<LinePoint, kTilePixels> points;
        TileRays rays;
        for (std::size_t place = 0; place < kTilePixels; ++place) {
            const glm::vec2 at = corner + glm::vec2(place % kTileSize, place / kTileSize);
            points[place] = nearestOnLine(line, solids.frame.perspective, at);
            rays.x[place] = points[place].at.x;
            rays.y[place] = points[place].at.y;
        }
        lookAtFlats(solids, {}, rays);
        for (std::size_t place = 0; place < kTilePixels; ++place) {
            const LinePoint& point = points[place];
            if (point.cover <= 0.0F || rays.depth[place] < point.depth * kNearer) continue;
            const float share = point.cover * shareInFront(samples, place, point.depth);
            over[place] = over[place] * (1.0F - share) + share * glm::vec4(line.color, 1.0F);
        }
    }
    return over;
}

}  // namespace render
