// Primary hits: what rays through the pixels of a tile meet first of spheres, boxes and the ground, as many rays at a
// time as a SIMD vector holds. Called by tile_samples.cpp. Only the identity and the depth of a hit are kept;
// shading_points.cpp computes its position and normal for the few samples that are shaded.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include <glm/glm.hpp>

#include "render/picture/camera_frame.h"
#include "render/picture/view.h"
#include "render/prepare/cells/hit_ids.h"
#include "render/prepare/cells/tiles.h"

namespace render {

struct MeshTiles;

/// View depth of a ray that hits nothing, m.
inline constexpr float kFarDepth = 3.0e38F;

/// All geometry but the metaballs.
struct SolidGeometry {
    CameraFrame frame;
    std::span<const ViewSphere> spheres;  ///< spheres in view coordinates
    std::span<const Rect> pixels;         ///< bounds of the pixels that each sphere may touch
    const CellLists* tiles = nullptr;     ///< spheres of each tile, front to back
    std::span<const BoxObstacle> boxes;
    std::span<const float> boxFronts;     ///< view depths that no point of a box is before, m
    const CellLists* boxTiles = nullptr;  ///< boxes of each tile, front to back
    std::optional<float> ground;          ///< height of the ground over the eye, m
    const MeshTiles* meshes = nullptr;    ///< null without meshes
};

/// One ray through each pixel of a tile, row by row, and its nearest hit so far.
struct TileRays {
    alignas(64) std::array<float, kTilePixels> x;  ///< positions of the rays on the picture, pixels
    alignas(64) std::array<float, kTilePixels> y;
    alignas(64) std::array<float, kTilePixels> depth;         ///< view depth of the hit, m; kFarDepth if there is none
    alignas(64) std::array<std::int32_t, kTilePixels> hitId;  ///< hit id of what the ray hits
};

/// Which of the ground and the boxes a tile may show.
struct FlatGeometry {
    bool hasGround = true;
    std::span<const std::uint32_t> boxes;  ///< front to back
};

/// The part of a rectangle of pixels that lies in a tile, from the tile's corner.
inline Rect withinTile(const Rect& pixels, int left, int top) {
    return {std::max(pixels.x0 - left, 0), std::max(pixels.y0 - top, 0), std::min(pixels.x1 - left, kTileSize - 1),
            std::min(pixels.y1 - top, kTileSize - 1)};
}

// The functions below give a ray a hit that depends on its own position alone, bit for bit, not on the instruction set.

/// Sets the hit of each ray to its nearest hit of the ground and the boxes.
void findFlatHits(const SolidGeometry& geometry, FlatGeometry flats, TileRays& rays);

/// Replaces the rays' hits by nearer ones of the spheres of a tile. @pre every ray goes through the tile
void findSphereHits(const SolidGeometry& geometry, std::size_t tile, std::span<TileRays> samples);

}  // namespace render
