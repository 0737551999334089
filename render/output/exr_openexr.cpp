// The module with OpenEXR: the only source that includes it.
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfOutputFile.h>
#include <ImfStandardAttributes.h>
#include <OpenEXRConfig.h>
#include <half.h>

#include <algorithm>
#include <cstddef>

#include "render/output/exr.h"
#include "render/output/openexr_module.h"

namespace render {
namespace {

/// A file in memory.
class MemoryStream : public Imf::OStream {
 public:
    MemoryStream() : Imf::OStream("memory") {}

    void write(const char* bytes, int count) override {
        const std::size_t end = position_ + static_cast<std::size_t>(count);
        if (end > bytes_.size()) bytes_.resize(end);
        std::copy_n(bytes, count, bytes_.begin() + static_cast<std::ptrdiff_t>(position_));
        position_ = end;
    }
    std::uint64_t tellp() override { return position_; }
    void seekp(std::uint64_t position) override { position_ = position; }

    std::vector<std::uint8_t> take() { return std::move(bytes_); }

 private:
    std::vector<std::uint8_t> bytes_;
    std::size_t position_ = 0;
};

/// The channels of a file, with where their values lie in memory.
class Channels {
 public:
    explicit Channels(PictureSize size) : header_(size.width, size.height), size_(size) {
        header_.compression() = Imf::ZIP_COMPRESSION;
        Imf::addComments(header_,
                         "R, G, B: linear, times alpha. Z: distance along the camera's axis, m; 1e10 where nothing is "
                         "seen. N: normal in world axes. id: 1 + the particle's id; 0 where none is seen.");
    }

    /// Adds a channel. @param pixelBytes  from a value to that of the next pixel, bytes
    void add(const char* name, Imf::PixelType type, const void* first, std::size_t pixelBytes) {
        header_.channels().insert(name, Imf::Channel(type));
        // OpenEXR reads frame buffers through pointers to char, as it writes them.
        auto* const base = const_cast<char*>(static_cast<const char*>(first));
        buffer_.insert(name, Imf::Slice(type, base, pixelBytes, pixelBytes * static_cast<std::size_t>(size_.width)));
    }

    std::vector<std::uint8_t> encoded() const {
        MemoryStream stream;
        {
            Imf::OutputFile file(stream, header_, 0);
            file.setFrameBuffer(buffer_);
            file.writePixels(size_.height);
        }
        return stream.take();
    }

 private:
    Imf::Header header_;
    Imf::FrameBuffer buffer_;
    PictureSize size_;
};

std::vector<std::uint8_t> encode(PictureSize size, const Layers& layers) {
    std::vector<half> color;
    color.reserve(4 * layers.color.size());
    for (const glm::vec4& pixel : layers.color)
        for (int channel = 0; channel < 4; ++channel) color.emplace_back(pixel[channel]);
    std::vector<float> depths;
    depths.reserve(layers.points.size());
    for (const VisiblePoint& point : layers.points) depths.push_back(point.depth < 0.0F ? kNoDepthInExr : point.depth);

    Channels channels(size);
    constexpr const char* kColors[] = {"R", "G", "B", "A"};
    for (std::size_t k = 0; k < 4; ++k) channels.add(kColors[k], Imf::HALF, &color[k], 4 * sizeof(half));
    channels.add("Z", Imf::FLOAT, depths.data(), sizeof(float));
    const glm::vec3& normal = layers.points.front().normal;
    channels.add("N.X", Imf::FLOAT, &normal.x, sizeof(VisiblePoint));
    channels.add("N.Y", Imf::FLOAT, &normal.y, sizeof(VisiblePoint));
    channels.add("N.Z", Imf::FLOAT, &normal.z, sizeof(VisiblePoint));
    channels.add("id", Imf::UINT, layers.ids.data(), sizeof(std::uint32_t));
    return channels.encoded();
}

}  // namespace
}  // namespace render

const render::OpenExrModule globularOpenExr = {OPENEXR_VERSION_STRING, render::encode};
