// What the renderer returns: the finished picture, which PNG and video take, and for the studies the point that each
// pixel shows.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

namespace render {

/// 8-bit sRGB pixels, row by row from the top left, three bytes each: red, green, blue.
struct Image {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> rgb;  ///< byteCount() of them

    std::size_t byteCount() const {
        return std::size_t{3} * static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    }
};

/// The first surface that the ray through a pixel's center meets. Of metaballs in draft and normal quality, it is
/// interpolated where the renderer casts no ray through that pixel.
struct VisiblePoint {
    glm::vec3 normal{0.0F};  ///< unit length, world axes
    float depth = -1.0F;     ///< view depth, m; -1 where the ray meets nothing
};

}  // namespace render
