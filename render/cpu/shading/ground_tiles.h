// What of the ground each tile of the picture may show. Most of many pictures is background, or ground that nothing
// occludes: such tiles are colored without shadows and with one ray per pixel. Called by the picture pass.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include <glm/glm.hpp>

#include "render/cpu/lighting/light_visibility.h"
#include "render/picture/camera_frame.h"

namespace render {

/// What of the ground may be seen in a tile where nothing hides it.
enum class GroundKind : std::uint8_t {
    none,      ///< no ground
    open,      ///< only ground, out of reach of all shadows and of the map of sky visibility
    occluded,  ///< only ground
    horizon    ///< ground in a part of the tile
};

struct GroundTile {
    GroundKind kind = GroundKind::none;
    float nearest = std::numeric_limits<float>::infinity();  ///< least view depth of the ground in the tile, m
};

/// Classifies the tiles of the picture, row by row. @param height  of the ground over the eye, m
std::vector<GroundTile> groundTiles(const CameraFrame& frame, float height, const Occluders& occluders);

}  // namespace render
