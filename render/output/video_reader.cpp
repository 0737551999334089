// ffmpeg writes each frame as a PPM file, whose head has the size: "P6\nWIDTH HEIGHT\n255\n", and then the pixels of an
// Image.
#include "render/output/video_reader.h"

#include <array>
#include <cstdio>

#include <fmt/format.h>

#include "render/picture/system_error.h"

namespace render {
namespace {

ChildProcess startedDecoder(const std::string& path) {
    try {
        // "file:" keeps ffmpeg from taking a path with a colon for a protocol.
        return ChildProcess(
            {"ffmpeg", "-hide_banner", "-loglevel", "error", "-xerror", "-nostdin", "-i", "file:" + path, "-fps_mode",
             "passthrough", "-sws_flags", "accurate_rnd+full_chroma_int+bitexact", "-pix_fmt", "rgb24", "-c:v", "ppm",
             "-f", "image2pipe", "pipe:1"},
            kNoTimeout, {}, StandardOutput::piped);
    } catch (const ProgramMissing& error) {
        throw SystemError(fmt::format("{}; install ffmpeg to read {}", error.what(), path));
    }
}

}  // namespace

VideoReader::VideoReader(std::string path) : path_(std::move(path)), ffmpeg_(startedDecoder(path_)) {}

std::optional<Image> VideoReader::next(const std::function<void()>& whileWaiting) {
    const auto fail = [&](const std::string& reason) -> SystemError {
        return SystemError(fmt::format("ffmpeg cannot decode {}: {}", path_, reason));
    };
    std::string head;
    for (int lines = 0; lines < 3;) {
        std::array<std::uint8_t, 1> byte{};
        if (ffmpeg_.read(byte, whileWaiting) == 0) break;
        head += static_cast<char>(byte[0]);
        lines += byte[0] == '\n' ? 1 : 0;
    }
    Image image;
    if (!head.empty() && std::sscanf(head.c_str(), "P6 %d %d 255", &image.width, &image.height) == 2) {
        image.rgb.resize(image.byteCount());
        if (ffmpeg_.read(image.rgb, whileWaiting) == image.rgb.size()) return image;
    }
    const std::string ending = ffmpeg_.wait();
    if (!ending.empty()) throw fail(fmt::format("{}: {}", ending, ffmpeg_.output()));
    if (!head.empty()) throw fail("its output ends within a frame");
    return std::nullopt;
}

}  // namespace render
