// Tiles of background, and of ground that nothing dims: one ray a pixel, because nothing in them has an outline. They
// look the same from picture to picture while the camera rests, and are not coloured again then. Used by the picture
// pass.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "render/camera_frame.h"
#include "render/shade.h"
#include "render/tile_class.h"
#include "render/view.h"

namespace render {

/// Everything that such a tile's pixels are computed from; positions relative to the eye, but for the frame's.
struct Backdrop {
    CameraFrame frame;
    Background background;
    glm::vec3 ground{0.0F};  ///< its colour, not faded yet
    float groundHeight = 0.0F;
    glm::vec3 groundCenter{0.0F};
    float fadeDistance = 1.0F;

    bool operator==(const Backdrop&) const = default;
};

class PlainTiles {
 public:
    /// Colours the plain ones of these tiles, row by row and so many a row. pixels: row by row; where the last picture
    /// of as many tiles had plain ones before the same backdrop, as it left them.
    void color(const Backdrop& backdrop, std::span<const TileClass> classes, int columns, std::span<PixelColor> pixels);

 private:
    Backdrop backdrop_;
    std::vector<TileClass> looks_;  // of the last picture
};

}  // namespace render
