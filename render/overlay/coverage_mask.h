// Coverage masks: how much of each pixel text and lines cover, and painting a color through such a mask. Used by all of
// render/overlay/.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "render/picture/image.h"

namespace render {

/// A rectangle of pixels, which may reach beyond the picture.
struct CoverageMask {
    int left = 0;  ///< in pixels of the picture, (0, 0) being its top left pixel
    int top = 0;
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> coverage;  ///< width * height, row by row: 0 is not covered at all, 255 completely
};

/// A rectangle in pixels of the picture; (0, 0) is its top left corner.
struct Box {
    double left = 0.0;
    double top = 0.0;
    double right = 0.0;
    double bottom = 0.0;
};

/// The smallest mask that contains the box, with nothing covered.
CoverageMask emptyMask(const Box& box);

/// Adds a rectangle. Pixels at its sides are covered by the share of their area that is inside.
void coverBox(CoverageMask& mask, const Box& box);

/// All that lies within a radius, in pixels, of what the mask covers, with a soft edge one pixel wide.
CoverageMask widened(const CoverageMask& mask, int radius);

/// 8-bit sRGB, as in an Image.
using Bytes = glm::tvec3<std::uint8_t>;

/// sRGB encoding of a linear color, clamped to [0, 1].
Bytes srgbBytes(const glm::vec3& linear);

/// Blends a color into the picture where the mask covers it. What lies outside of the picture is left out.
/// @param opacity  from 0 to 255, a factor on the coverage
void paint(Image& image, const CoverageMask& mask, const Bytes& color, int opacity = 255);

}  // namespace render
