// Every layer becomes the samples of a PNG file, row by row, or all of them one OpenEXR file.
#include "render/picture_formats.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include <fmt/format.h>

#include "render/cpu/shading/shade.h"
#include "render/output/exr.h"
#include "render/output/png.h"

namespace render {

namespace {

using Bytes = std::vector<std::uint8_t>;

void appendSample(std::uint32_t value, Bytes& to) {
    to.push_back(static_cast<std::uint8_t>(value >> 8 & 0xffU));
    to.push_back(static_cast<std::uint8_t>(value & 0xffU));
}

/// Room for the samples of a picture of 16 bits a channel.
Bytes roomFor(const PictureScale& scale, std::size_t channels) {
    Bytes bytes;
    bytes.reserve(2 * channels * static_cast<std::size_t>(scale.size.width) *
                  static_cast<std::size_t>(scale.size.height));
    return bytes;
}

Bytes encodeRgb(const PictureScale&, const Layers& layers) {
    return encodePng(layers.image);
}

/// Colors are divided by alpha, and encoded as in the finished picture, but without dither.
Bytes encodeRgba(const PictureScale& scale, const Layers& layers) {
    Bytes bytes(4 * layers.color.size());
    for (std::size_t first = 0; first < layers.color.size(); first += kTilePixels) {
        const std::size_t count = std::min<std::size_t>(kTilePixels, layers.color.size() - first);
        PointColors straight{};
        for (std::size_t k = 0; k < count; ++k) {
            const glm::vec4& pixel = layers.color[first + k];
            for (int channel = 0; channel < 3; ++channel)
                straight.rgb[static_cast<std::size_t>(channel)][k] = pixel.a > 0.0F ? pixel[channel] / pixel.a : 0.0F;
        }
        alignas(64) std::array<PixelColor, kTilePixels> encoded;
        encodeColors(straight, Rounding::nearest, encoded.data());
        for (std::size_t k = 0; k < count; ++k) {
            std::uint8_t* const to = &bytes[4 * (first + k)];
            for (std::size_t channel = 0; channel < 3; ++channel)
                to[channel] = static_cast<std::uint8_t>(encoded[k] >> (8 * channel) & 0xffU);
            to[3] = static_cast<std::uint8_t>(layers.color[first + k].a * 255.0F + 0.5F);
        }
    }
    return encodePng({scale.size, 4, 1, bytes});
}

Bytes encodeDepth(const PictureScale& scale, const Layers& layers) {
    Bytes bytes = roomFor(scale, 1);
    for (const VisiblePoint& point : layers.points) {
        const double steps = std::floor(double(point.depth) / scale.depthStep + 0.5);
        appendSample(point.depth < 0.0F || steps > kNoDepth ? kNoDepth : static_cast<std::uint32_t>(steps), bytes);
    }
    return encodePng({scale.size,
                      1,
                      2,
                      bytes,
                      {{"MetersPerStep", fmt::format("{}", scale.depthStep)},
                       {"Description", "distance along the camera's axis; 65535: nothing, or too far"}}});
}

/// 0 for nothing, which no normal is encoded as.
Bytes encodeNormal(const PictureScale& scale, const Layers& layers) {
    Bytes bytes = roomFor(scale, 3);
    for (const VisiblePoint& point : layers.points)
        for (int axis = 0; axis < 3; ++axis) {
            const float value = std::clamp(point.normal[axis], -1.0F, 1.0F) * 32767.5F + 32768.0F;
            appendSample(point.depth < 0.0F ? 0 : static_cast<std::uint32_t>(value), bytes);
        }
    return encodePng({scale.size,
                      3,
                      2,
                      bytes,
                      {{"Description",
                        "normals in world axes: red, green and blue are x, y and z from -1 to 1; 0, 0, 0: "
                        "nothing"}}});
}

Bytes encodeIds(const PictureScale& scale, const Layers& layers) {
    Bytes bytes = roomFor(scale, 3);
    for (const std::uint32_t id : layers.ids) {
        appendSample(id & 0xffffU, bytes);
        appendSample(id >> 16, bytes);
        appendSample(0, bytes);
    }
    return encodePng(
        {scale.size, 3, 2, bytes, {{"Description", "particles: red + 65536 green is 1 + the id; 0: no particle"}}});
}

Bytes encodeAll(const PictureScale& scale, const Layers& layers) {
    return encodeExr(scale.size, layers);
}

constexpr std::array<PictureFormat, 6> kFormats = {
    {{"rgb", ".png", "the finished picture", {.image = true}, encodeRgb},
     {"rgba", ".rgba.png", "without background and overlay, with straight alpha", {.color = true}, encodeRgba},
     {"depth",
      ".depth.png",
      "16 bits, distance along the camera's axis, 65535 for nothing; run.json and the file have its scale",
      {.points = true},
      encodeDepth},
     {"normal",
      ".normal.png",
      "16 bits a channel, normals in world axes from -1 to 1, black for nothing",
      {.points = true},
      encodeNormal},
     {"id",
      ".id.png",
      "16 bits a channel, red + 65536 green is 1 + the id of the particle, 0 for none",
      {.ids = true},
      encodeIds},
     {"exr",
      ".exr",
      "OpenEXR with R, G, B, A (linear, times alpha), Z (m), N.X, N.Y, N.Z and id",
      {.color = true, .points = true, .ids = true},
      encodeAll}}};

}  // namespace

std::span<const PictureFormat> pictureFormats() {
    return kFormats;
}

void requireFormat(const PictureFormat& format) {
    if (format.encode == encodeAll) requireOpenExr();
}

}  // namespace render
