// Primary hits: what rays through the pixels of a tile meet first of spheres, boxes and the ground, as many rays at a
// time as a SIMD vector holds. Called by tile_samples.cpp. Only the identity and the depth of a hit are kept;
// shading_points.cpp computes its position and normal for the few samples that are shaded.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include <glm/glm.hpp>

#include "render/picture/camera_frame.h"
#include "render/picture/view.h"
#include "render/prepare/tiles.h"

namespace render {

// What a ray hits, as one number. From 0 on: the index of a sphere.
inline constexpr std::int32_t kHitBackground = -1;
inline constexpr std::int32_t kHitGround = -2;
/// From here on: 16 times a box's index, plus its face (0 +x, 1 -x, 2 +y, ... 5 -z), plus 8 where the eye is inside.
inline constexpr std::int32_t kHitBox = 1 << 28;
/// From here on: an index in MetaballHits::hits.
inline constexpr std::int32_t kHitMetaballs = 1 << 29;

inline constexpr float kFarDepth = 3.0e38F;

/// All geometry but the metaballs.
struct SolidGeometry {
    CameraFrame frame;
    std::span<const ViewSphere> spheres;
    std::span<const Rect> pixels;      ///< that each sphere may touch
    const CellLists* tiles = nullptr;  ///< of the spheres, front to back
    std::span<const BoxObstacle> boxes;
    std::optional<float> ground;  ///< its height over the eye, m
};

/// One ray through each pixel of a tile, row by row, and its nearest hit so far.
struct TileRays {
    alignas(64) std::array<float, kTilePixels> x;  ///< positions on the picture, pixels
    alignas(64) std::array<float, kTilePixels> y;
    alignas(64) std::array<float, kTilePixels> depth;  ///< view depth, m; kFarDepth: no hit
    alignas(64) std::array<std::int32_t, kTilePixels> hitId;
};

/// Which of the ground and the boxes a tile may show.
struct FlatGeometry {
    bool hasGround = true;
    bool hasBoxes = true;
};

// Of the functions below, a ray's result depends on its own position alone, bit for bit, not on the instruction set.

/// Starts the rays' hits with those of the ground and the boxes.
void findFlatHits(const SolidGeometry& geometry, FlatGeometry flats, TileRays& rays);

/// Adds the spheres of a tile. @pre every ray goes through the tile
void findSphereHits(const SolidGeometry& geometry, std::size_t tile, std::span<TileRays> samples);

}  // namespace render
