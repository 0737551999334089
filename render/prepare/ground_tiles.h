// Which tiles of the picture show the ground, and on which of these something may occlude its light: most of a picture
// is plain ground and background, for which no shadow needs to be computed. Called by the picture pass.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include <glm/glm.hpp>

#include "render/picture/camera_frame.h"
#include "render/prepare/light_space.h"

namespace render {

/// Bounds of all that may hide the light or the sky from the ground, relative to the eye. Empty where low is above
/// high.
struct OccluderBounds {
    LightBasis light;
    glm::vec2 shadowLow{1.0F};  ///< on the light's plane (u, v), of all shadow casters, soft edges included
    glm::vec2 shadowHigh{-1.0F};
    glm::vec2 skyMapLow{1.0F};  ///< x and z, of the ground's sky visibility map
    glm::vec2 skyMapHigh{-1.0F};
};

/// What a tile shows of the ground.
enum class GroundKind : std::uint8_t {
    none,
    plain,     ///< ground all over the tile, outside of all bounds
    occluded,  ///< ground all over the tile, which may be occluded
    horizon    ///< ground in a part of the tile, which may be occluded
};

struct GroundTile {
    GroundKind kind = GroundKind::none;
    float nearest = std::numeric_limits<float>::infinity();  ///< view depth of the nearest ground in the tile
};

/// The tiles of the picture, row by row.
/// @param height  of the ground relative to the eye, m
/// @param bounds  tiles whose ground lies outside of these are plain
std::vector<GroundTile> groundTiles(const CameraFrame& frame, float height, const OccluderBounds& bounds);

}  // namespace render
