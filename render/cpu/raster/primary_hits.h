// What rays through the pixels of a tile see first: spheres, boxes and the ground, on the CPU, as many rays at a time
// as the machine has lanes. Called by picture_samples.cpp.
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

/// What a ray sees, as one number. From 0 on: a sphere's index.
inline constexpr std::int32_t kSeesBackground = -1;
inline constexpr std::int32_t kSeesGround = -2;
/// From here on: 16 a box, plus its face (0 +x, 1 -x, 2 +y, ... 5 -z), plus 8 where the eye is inside.
inline constexpr std::int32_t kSeesBox = 1 << 28;
/// From here on: a sample of the metaballs' surface.
inline constexpr std::int32_t kSeesField = 1 << 29;

inline constexpr float kFarDepth = 3.0e38F;

/// All that is solid, but for the metaballs.
struct Solids {
    CameraFrame frame;
    std::span<const ViewSphere> spheres;
    std::span<const Rect> pixels;      ///< that each sphere may touch
    const CellLists* tiles = nullptr;  ///< of the spheres, front to back
    std::span<const BoxObstacle> boxes;
    std::optional<float> ground;  ///< its height over the eye, m
};

/// One ray through each pixel of a tile, row by row, and what it sees so far.
struct TileRays {
    alignas(64) std::array<float, kTilePixels> x;  ///< pixels of the picture
    alignas(64) std::array<float, kTilePixels> y;
    alignas(64) std::array<float, kTilePixels> depth;  ///< view depth; kFarDepth: nothing
    alignas(64) std::array<std::int32_t, kTilePixels> seen;
};

/// What a tile may show besides spheres.
struct Flats {
    bool ground = true;
    bool boxes = true;
};

/// Begins a picture of these rays: what of the ground and the boxes each sees.
/// Holds:  here and below a ray's result depends on its own position alone, bit for bit, not on the number of lanes.
void lookAtFlats(const Solids& solids, Flats flats, TileRays& rays);

/// Adds the spheres of this tile.  \pre  every ray goes through the tile.
void lookAtSpheres(const Solids& solids, std::size_t tile, std::span<TileRays> samples);

/// Begins a picture of rays that all meet the ground, and adds the spheres: the same as with lookAtFlats(), but for the
/// depth of the ground, which stays kFarDepth. What stands on the ground hides it, so that its depth is rarely needed.
void lookAtSpheresOnGround(const Solids& solids, std::size_t tile, std::span<TileRays> samples);

}  // namespace render
