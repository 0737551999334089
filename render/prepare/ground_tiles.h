// Finds the tiles of the picture that show nothing but background or ground, which are most tiles of many pictures.
// They are colored without a search for what their rays hit, and without shadows where none can fall. Called by the
// view's preparation.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "render/picture/camera_frame.h"
#include "render/picture/view.h"
#include "render/prepare/ambient_occlusion.h"
#include "render/prepare/depth_map_grid.h"
#include "render/prepare/light_space.h"

namespace render {

/// What a tile of the picture shows.
enum class TileKind : std::uint8_t {
    background,      ///< nothing but the background
    openGround,      ///< nothing but ground, out of reach of all shadows and with the whole sky visible
    occludedGround,  ///< nothing but ground that may be shadowed or see only a part of the sky
    mixed            ///< anything else, or several of these
};

/// What may shade the ground. A pointer is null where there is nothing of its kind.
struct GroundOccluders {
    LightBasis light;
    glm::vec3 eye{0.0F};  ///< world coordinates, m
    const LightGrid* spheres = nullptr;
    const DepthMapGrid* metaballs = nullptr;
    std::span<const BoxObstacle> boxes;
    float softEdge = 0.0F;  ///< width of the soft edges of the boxes' shadows, m
    const SkyVisibilityMap* sky = nullptr;
};

/// Classifies the tiles of the picture, row by row, by what they show as long as nothing stands before the ground.
/// @param height  height of the ground over the eye, m
std::vector<TileKind> groundTiles(const CameraFrame& frame, float height, const GroundOccluders& occluders);

}  // namespace render
