// Tile by tile: the hits of the rays, their shading points, and for metaballs the ball that the point belongs to.
#include "render/cpu/surface_layers.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include <tbb/parallel_for.h>

#include "render/cpu/lighting/shading_points.h"
#include "render/cpu/metaballs/strongest_ball.h"
#include "render/cpu/tile_samples.h"

namespace render {

namespace {

/// The number of a particle, as Layers::ids has it.
std::uint32_t numberOf(const PreparedView& view, std::size_t particle) {
    return 1 + view.view->particleIds[particle];
}

/// The numbers of the particles that a tile's pixels show.
std::array<std::uint32_t, kTilePixels> particleNumbers(const PreparedView& view, std::size_t tile,
                                                       const TileRays& rays) {
    std::array<std::uint32_t, kTilePixels> numbers{};
    HitPoints onMetaballs;
    for (std::size_t k = 0; k < kTilePixels; ++k) {
        const std::int32_t hit = rays.hitId[k];
        if (hit >= 0 && hit < view.drawn.firstObstacle)
            numbers[k] = numberOf(view, view.drawn.sources[static_cast<std::size_t>(hit)]);
        if (hit >= kHitMetaballs) onMetaballs.add(view.frame, k, {rays.x[k], rays.y[k]}, rays.depth[k]);
    }
    if (onMetaballs.count == 0) return numbers;
    findStrongestBalls(view.metaballs, tile, onMetaballs);
    for (std::size_t k = 0; k < onMetaballs.count; ++k)
        if (onMetaballs.ball[k] != HitPoints::kNoBall)
            numbers[onMetaballs.pixel[k]] = numberOf(view, view.metaballs.particles[onMetaballs.ball[k]]);
    return numbers;
}

std::array<VisiblePoint, kTilePixels> visiblePoints(const ShadingGeometry& geometry, const TileRays& rays) {
    ShadingPoints points;
    points.count = kTilePixels;
    points.hitId = rays.hitId;
    points.x = rays.x;
    points.y = rays.y;
    evaluateShadingPoints(geometry, points);
    std::array<VisiblePoint, kTilePixels> found;
    for (std::size_t k = 0; k < kTilePixels; ++k) {
        if (points.hitId[k] == kHitBackground) continue;
        found[k] = {{points.normal[0][k], points.normal[1][k], points.normal[2][k]}, points.depth[k]};
    }
    return found;
}

/// Copies the part of a tile that lies in the picture.
template <typename Value>
void copyTile(const std::array<Value, kTilePixels>& tile, glm::ivec2 corner, const CameraFrame& frame,
              std::vector<Value>& layer) {
    const int columns = std::min(kTileSize, frame.width - corner.x);
    const int rows = std::min(kTileSize, frame.height - corner.y);
    for (int row = 0; row < rows; ++row)
        std::copy_n(tile.begin() + row * kTileSize, columns,
                    layer.begin() + std::ptrdiff_t{corner.y + row} * frame.width + corner.x);
}

}  // namespace

void findSurfaceLayers(const PictureJob& job, const PreparedView& view, const LayerSelection& wanted, Layers& layers) {
    const CameraFrame& frame = view.frame;
    const auto pixelCount = static_cast<std::size_t>(frame.width) * static_cast<std::size_t>(frame.height);
    if (wanted.points) layers.points.resize(pixelCount);
    if (wanted.ids) layers.ids.resize(pixelCount);
    const CellLists& tiles = *job.contents.geometry.tiles;
    const std::array<glm::vec2, 1> middle{};
    tbb::parallel_for(std::size_t{0}, tiles.cellCount(), [&](std::size_t tile) {
        const TileSamples samples(job.contents, middle, tile);
        const TileRays& rays = samples.rays()[0];
        const glm::ivec2 corner(tileCorner(tiles, tile));
        if (wanted.points) copyTile(visiblePoints(job.geometry, rays), corner, frame, layers.points);
        if (wanted.ids) copyTile(particleNumbers(view, tile, rays), corner, frame, layers.ids);
    });
}

}  // namespace render
