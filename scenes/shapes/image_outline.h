// Outlines of the dark parts of images.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "scenes/shapes/extrusion.h"

namespace scenes {

/// An outline, and the share of its width that an image is high.
struct ImageOutline {
    Outline outline;
    double aspect = 1.0;  ///< height of the image over its width
};

/// The outline of what is darker than middle gray in a PNG, around the middle of the image, which is 1 m wide. What is
/// transparent counts as light. Throws InputError, which names the path, if the bytes are no image.
ImageOutline imageOutline(const std::vector<std::uint8_t>& bytes, const std::string& path);

}  // namespace scenes
