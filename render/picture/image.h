// What the renderer returns: the finished picture, which becomes a PNG file or a frame of a video, and for the studies
// the point of a surface that each pixel shows.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "render/picture/view.h"

namespace render {

/// 8-bit sRGB pixels, row by row from the top left, three bytes each: red, green, blue.
struct Image {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> rgb;  ///< red, green and blue of each pixel

    std::size_t byteCount() const {
        return std::size_t{3} * static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    }
};

/// Packs pixels of four bytes, of which the lowest is red, into an image.
/// @param rowLength  number of pixels from one row to the next
/// @param old  an image that is no longer needed, whose memory is reused
Image packedImage(PictureSize size, std::span<const std::uint32_t> pixels, int rowLength, Image old);

/// Where the ray through a pixel's center first meets a surface. On metaballs in draft and normal quality, the point is
/// interpolated where the renderer casts no ray through the pixel.
struct VisiblePoint {
    glm::vec3 normal{0.0F};  ///< surface normal in world axes, unit length; of no meaning where the ray meets nothing
    float depth = -1.0F;     ///< view depth of the point, m; -1 where the ray meets nothing
};

}  // namespace render
