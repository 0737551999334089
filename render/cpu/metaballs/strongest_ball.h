// The particle that a point of metaballs belongs to: that whose ball contributes most to the field there. Called by
// surface_layers.cpp.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

#include <glm/glm.hpp>

#include "render/prepare/cells/tiles.h"
#include "render/prepare/metaball_scene.h"

namespace render {

/// Points at which rays through pixels of a tile hit metaballs, as a structure of arrays.
struct HitPoints {
    static constexpr std::uint32_t kNoBall = std::numeric_limits<std::uint32_t>::max();

    std::size_t count = 0;
    std::array<std::uint8_t, kTilePixels> pixel;  ///< column + 16 row within the tile
    std::array<float, kTilePixels> x, y, z;       ///< view coordinates, m
    std::array<std::uint32_t, kTilePixels> ball;  ///< index of the ball in the scene, or kNoBall

    /// Adds the point at this view depth of the ray through a point of the picture.
    void add(const CameraFrame& frame, std::size_t pixelIndex, glm::vec2 onPicture, float depth);
};

/// Sets the ball of each point: that with the greatest term of the field, and of equal ones the first of the tile's
/// list. kNoBall where no kernel reaches the point.
void findStrongestBalls(const MetaballScene& scene, std::size_t tile, HitPoints& points);

}  // namespace render
