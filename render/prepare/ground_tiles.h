// Which tiles of the picture show the ground, and on which of them something may dim it: most of a picture is plain
// ground and background, for which no shadow is looked up. Called by the picture pass.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include <glm/glm.hpp>

#include "render/picture/camera_frame.h"
#include "render/prepare/light_space.h"

namespace render {

/// What may dim the ground, positions relative to the eye. Empty bounds (low above high) dim nothing.
struct OccluderBounds {
    LightBasis light;
    glm::vec2 shadowLow{1.0F};  ///< bounds of all that casts shadows, on the light's plane, soft edges included
    glm::vec2 shadowHigh{-1.0F};
    glm::vec2 skyMapLow{1.0F};  ///< bounds of the map of openness, x and z
    glm::vec2 skyMapHigh{-1.0F};
};

enum class GroundKind : std::uint8_t {
    none,
    plain,
    occluded,
    horizon  ///< ends in it, and may be dimmed
};

struct GroundTile {
    GroundKind kind = GroundKind::none;
    float nearest = std::numeric_limits<float>::infinity();  ///< view depth of what is seen of it
};

/// Row by row. height: of the ground over the eye.
/// Holds:  a tile called none shows no ground, one called plain no ground within the bounds.
std::vector<GroundTile> groundTiles(const CameraFrame& frame, float height, const OccluderBounds& occluderBounds);

}  // namespace render
