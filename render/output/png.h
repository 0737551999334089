// PNG encoding and decoding in memory. Called by tools/, which reads and writes the files.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "render/picture/image.h"

namespace render {

/// Encodes fast rather than small: a picture of 1280x720 pixels takes 3 ms. libdeflate at its fastest takes 10 ms for a
/// file that is 4 to 7 % smaller (measured). The bytes for the same pixels may depend on the processor.
std::vector<std::uint8_t> encodePng(const Image& image);

/// @param name  of the file, for messages
/// @throws SystemError for what is not a PNG file, has more than eight bits per channel or is not opaque
Image decodePng(std::span<const std::uint8_t> bytes, const std::string& name);

}  // namespace render
