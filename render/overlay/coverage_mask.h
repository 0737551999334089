// Coverage masks: what text and lines cover of a picture's pixels, and how a color gets through them onto the picture.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "render/picture/image.h"

namespace render {

/// A rectangle of pixels, each covered from 0 (not at all) to 255 (wholly). It may reach beyond the picture.
/// Holds:  coverage.size() == width * height, row by row from the top left.
struct CoverageMask {
    int left = 0;
    int top = 0;
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> coverage;
};

/// In pixels of the picture, (0, 0) its upper left corner.
struct Box {
    double left = 0.0;
    double top = 0.0;
    double right = 0.0;
    double bottom = 0.0;
};

/// Nothing covered yet; contains the box.
CoverageMask emptyMask(const Box& box);

/// Adds a rectangle; pixels at its sides are covered by their share.
void coverBox(CoverageMask& mask, const Box& box);

/// Everything within a radius in pixels of what the mask covers, with a soft edge one pixel wide.
CoverageMask widened(const CoverageMask& mask, int radius);

/// 8-bit sRGB, as in an Image.
using Bytes = glm::tvec3<std::uint8_t>;

/// The nearest bytes of a linear color.
Bytes srgbBytes(const glm::vec3& linear);

/// Lays a color over the picture where the mask covers it; opacity from 0 to 255. What is beyond the picture is
/// left out.
void paint(Image& image, const CoverageMask& mask, const Bytes& color, int opacity = 255);

}  // namespace render
