// Finds the tiles of the picture that show nothing but background or ground, which are most tiles of many pictures.
// They are colored without a search for what their rays hit, and without shadows where none can fall. Called by the
// picture pass.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "render/cpu/lighting/light_visibility.h"
#include "render/picture/camera_frame.h"

namespace render {

/// What a tile of the picture shows.
enum class TileKind : std::uint8_t {
    background,      ///< nothing but the background
    openGround,      ///< nothing but ground, out of reach of all shadows and with the whole sky visible
    occludedGround,  ///< nothing but ground that may be shadowed or see only a part of the sky
    mixed            ///< anything else, or several of these
};

/// Classifies the tiles of the picture, row by row, by what they show as long as nothing stands before the ground.
/// @param height  height of the ground over the eye, m
std::vector<TileKind> groundTiles(const CameraFrame& frame, float height, const Occluders& occluders);

}  // namespace render
