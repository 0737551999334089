// Tiles of background, and of ground that nothing dims: one ray a pixel, because nothing in them has an outline. They
// look the same from picture to picture while the camera rests, and are not colored again then. Used by the picture
// pass.
#pragma once

#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "render/cpu/shading/shade.h"
#include "render/cpu/shading/tile_class.h"
#include "render/picture/camera_frame.h"
#include "render/picture/view.h"

namespace render {

/// Everything that such a tile's pixels are computed from; positions relative to the eye.
struct Backdrop {
    CameraFrame frame;  ///< its eye at 0
    Background background;
    glm::vec3 ground{0.0F};  ///< its color, not faded yet; all of the ground's where there is one
    float groundHeight = 0.0F;
    glm::vec3 groundCenter{0.0F};
    float fadeDistance = 1.0F;

    bool operator==(const Backdrop&) const = default;
};

class PlainTiles {
 public:
    /// Colors those of these tiles that are plain, and were not the same in the last call with an equal backdrop.
    /// classes: of the tiles, row by row, so many a row. pixels: of whole tiles, row by row; those of plain tiles as
    /// the last call left them.
    void color(const Backdrop& backdrop, std::span<const TileClass> classes, int columns, std::span<PixelColor> pixels);

 private:
    Backdrop backdrop_;
    std::vector<TileClass> classes_;  // in the last call
};

}  // namespace render
