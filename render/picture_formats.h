// The kinds of files that a frame can be written as: the finished picture, and layers for compositing. Called by the
// command `render`.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "render/picture/layers.h"

namespace render {

/// What the encoders need to know beside the layers.
struct PictureScale {
    PictureSize size;
    /// View depth of one step of a 16-bit depth picture, m.
    double depthStep = 1.0;
};

/// The value of a pixel of a depth picture where nothing is seen, or only what is too far for the scale.
inline constexpr int kNoDepth = 65535;

struct PictureFormat {
    std::string_view name;       ///< as --format has it
    std::string_view extension;  ///< of its files, such as ".depth.png"
    std::string_view help;
    LayerSelection layers;  ///< that it is made of
    std::vector<std::uint8_t> (*encode)(const PictureScale& scale, const Layers& layers);
};

/// All formats; the first, the finished picture, is the default.
std::span<const PictureFormat> pictureFormats();

/// Makes sure that files of this format can be made. @throws SystemError if a library is missing
void requireFormat(const PictureFormat& format);

}  // namespace render
