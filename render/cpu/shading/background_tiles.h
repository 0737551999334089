// Tiles that show nothing but background or ground, which is most of many pictures. Tiles are told apart once per
// picture, and those of background and of ground that nothing occludes are colored here, with one ray per pixel,
// because nothing in them has an outline. Called by the picture pass and picture_colors.cpp.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include <glm/glm.hpp>

#include "render/cpu/lighting/light_visibility.h"
#include "render/cpu/lighting/shading_points.h"
#include "render/cpu/shading/shade.h"
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

/// Where a tile's pixels are written.
struct TileTarget {
    glm::ivec2 corner{0};   ///< top left of the tile, pixels of the picture
    PixelColor* first;      ///< that corner's pixel
    std::size_t rowLength;  ///< of the picture, in whole tiles, pixels
};

/// Colors a tile of background, or of open ground in front of it.
void colorBackgroundTile(const ShadingGeometry& geometry, const Shading& shading, bool isGround,
                         const TileTarget& target);

}  // namespace render
