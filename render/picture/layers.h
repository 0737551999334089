// What can be drawn of a view beside the finished picture, for compositing: layers that a program like Nuke or Blender
// puts over others. Filled in by the Renderer, encoded by picture_formats.cpp.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "render/picture/image.h"

namespace render {

/// Which layers are drawn.
struct LayerSelection {
    bool image = false;   ///< Layers::image
    bool color = false;   ///< Layers::color
    bool points = false;  ///< Layers::points
    bool ids = false;     ///< Layers::ids

    bool any() const { return image || color || points || ids; }
    /// Whether light is computed.
    bool isShaded() const { return image || color; }
};

/// The layers of one picture, row by row from the top left. Those that are not drawn keep what they had.
struct Layers {
    Image image;  ///< the finished picture, with background and overlay
    /// The picture without background and overlay: linear RGB from 0 to 1 that is multiplied by alpha, and alpha. Alpha
    /// is the share of the pixel's samples that hit something. Ground has the share that is not background (section 2
    /// of shading_model.h), edges of boxes that of the pixel which they cover. RGB + (1 - alpha) background is the
    /// finished picture.
    std::vector<glm::vec4> color;
    std::vector<VisiblePoint> points;  ///< the point that each pixel's center shows; edges of boxes are left out
    /// The particle that each pixel's center shows: 1 + its number in View::particleIds, or 0 where it shows none. On
    /// metaballs it is the particle whose ball contributes most to the field there.
    std::vector<std::uint32_t> ids;
};

}  // namespace render
