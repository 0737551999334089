// Coverage masks: how much of each pixel text and lines cover, and painting a color through such a mask. Used by all of
// render/overlay/.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "render/picture/image.h"

namespace render {

/// How much of each pixel is covered, in a rectangle of pixels that may reach beyond the picture.
struct CoverageMask {
    int left = 0;  ///< first column of the rectangle; the leftmost of the picture is 0
    int top = 0;
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> coverage;  ///< coverage of each pixel, row by row: 0 none, 255 complete
};

/// A rectangle in pixels of the picture; (0, 0) is its top left corner.
struct Box {
    double left = 0.0;
    double top = 0.0;
    double right = 0.0;
    double bottom = 0.0;
};

/// The smallest mask of whole pixels that contains a box, with nothing covered.
CoverageMask emptyMask(const Box& box);

/// Adds to the coverage of a pixel of the picture, up to 255. Pixels outside of the mask are left out.
void addCoverage(CoverageMask& mask, int x, int y, int coverage);

/// Covers a rectangle in the mask. Pixels at the sides of the rectangle are covered by the share of their area that is
/// inside.
void coverBox(CoverageMask& mask, const Box& box);

/// A mask of all pixels within a radius, in pixels, of those that the given mask covers, with a soft edge one pixel
/// wide.
CoverageMask widened(const CoverageMask& mask, int radius);

/// A color as three bytes of sRGB: red, green and blue.
using Bytes = glm::tvec3<std::uint8_t>;

/// Clamps a linear color to [0, 1] and encodes it as 8-bit sRGB.
Bytes srgbBytes(const glm::vec3& linear);

/// Blends a color into the picture where the mask covers it. What lies outside of the picture is left out.
/// @param opacity  factor on the coverage, from 0 to 255 for 0 to 1
void paint(Image& image, const CoverageMask& mask, const Bytes& color, int opacity = 255);

}  // namespace render
