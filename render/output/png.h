// PNG in memory. Libraries write no files: the caller does.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "render/picture/image.h"

namespace render {

/// Fast rather than small: a picture of 1280x720 pixels takes 3 ms; libdeflate at its fastest takes 10, and the file is
/// 4 to 7 % smaller (measured). Which bytes stand for the same pixels may depend on the processor.
std::vector<std::uint8_t> encodePng(const Image& image);

/// Throws SystemError, with the name, for what is no PNG, has more than eight bits a channel or is not opaque.
Image decodePng(std::span<const std::uint8_t> bytes, const std::string& name);

}  // namespace render
