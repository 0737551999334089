// PNG encoding and decoding in memory. Called by tools/, which reads and writes the files.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "render/picture/image.h"

namespace render {

/// Samples that become a PNG file.
struct PngSamples {
    PictureSize size;
    int channels = 3;                     ///< 1: gray; 3: red, green, blue; 4: with straight alpha
    int bytesPerSample = 1;               ///< 1 or 2
    std::span<const std::uint8_t> bytes;  ///< the samples of each pixel, row by row; of two bytes the high one first
    /// Keywords and texts for other programs, in Latin-1. A keyword has at most 79 characters.
    std::vector<std::pair<std::string, std::string>> texts = {};
};

/// Encodes samples as PNG, as fast as an image.
std::vector<std::uint8_t> encodePng(const PngSamples& samples);

/// Encodes an image as PNG, fast rather than small: 1280x720 pixels take 3 ms. libdeflate at its fastest takes 10 ms
/// for a file that is 4 to 7 % smaller (measured). The bytes for the same pixels may depend on the processor.
std::vector<std::uint8_t> encodePng(const Image& image);

/// Decodes a PNG file.
/// @param name  name of the file, for messages
/// @throws SystemError if the bytes are not a PNG file, have more than eight bits per channel or are not opaque
Image decodePng(std::span<const std::uint8_t> bytes, const std::string& name);

}  // namespace render
