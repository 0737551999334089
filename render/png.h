// PNG in memory. Libraries write no files: the caller does.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "render/image.h"

namespace render {

/// Fast rather than small: libdeflate's level 1 takes a quarter of the time of stb's own compressor, and the file is
/// smaller.
std::vector<std::uint8_t> encodePng(const Image& image);

/// Throws SystemError, with the name, for what is no PNG, has more than eight bits a channel or is not opaque.
Image decodePng(std::span<const std::uint8_t> bytes, const std::string& name);

}  // namespace render
