// A finished picture in memory, as the renderer returns it and as PNG and video take it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace render {

/// Pixels row by row from the top left, three bytes each: red, green, blue, sRGB encoded.
/// Holds:  rgb.size() == 3 * width * height.
struct Image {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> rgb;

    /// Number of bytes that the pixels take.
    std::size_t byteCount() const {
        return std::size_t{3} * static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    }
};

}  // namespace render
