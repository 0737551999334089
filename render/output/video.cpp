// Runs ffmpeg to encode a video: its command line, the pixels that are sent to it, and its errors.
#include "render/output/video.h"

#include <algorithm>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>

#include "render/picture/system_error.h"

namespace render {

namespace {

/// A width or height in pixels, rounded up to an even number.
int even(int pixels) {
    return pixels + pixels % 2;
}

ChildProcess started(const std::vector<std::string>& arguments, const VideoOptions& options) {
    try {
        return ChildProcess(arguments, options.progressTimeout);
    } catch (const ProgramMissing& error) {
        throw SystemError(fmt::format("{}; install ffmpeg or render frames only", error.what()));
    }
}

/// The arguments that start ffmpeg. The reasons for its options:
///  - The same bytes on any processor: bit-exact scaling and muxing, no encoder settings in the stream
///    (filter_units), and a fixed number of encoder threads, on which the bytes depend.
///  - Colors: without the conversion to BT.709 and its tags, ffmpeg assumes BT.601 and colors shift. The pixel
///    format yuv420p requires an even width and height.
///  - Errors: without -xerror, a failure to write the end of the file would count as success.
///  - Speed: superfast, because the encoder shares the processor with the drawing. Without B-frames and weighted
///    prediction it takes a quarter less time (measured: mp4_ms of `globular study pictures`, 10,000 metaballs
///    at 1280 x 720) for a quarter more bytes (`globular render splash --size 1280x720 --frames 40-69 --video`).
std::vector<std::string> commandLine(const VideoOptions& options, const std::string& path) {
    const std::string filter = "scale=in_range=full:out_range=tv:out_color_matrix=bt709:flags=accurate_rnd+bitexact";
    return {options.ffmpeg, "-hide_banner", "-loglevel", "error", "-xerror", "-nostdin", "-y", "-f", "rawvideo",
            "-pix_fmt", "rgb24", "-video_size",
            fmt::format("{}x{}", even(options.size.width), even(options.size.height)), "-framerate",
            options.frameRate.text(), "-i", "-", "-vf", filter, "-c:v", "libx264", "-preset", "superfast", "-bf", "0",
            "-x264-params", "weightp=0", "-crf", "20", "-pix_fmt", "yuv420p", "-threads", "2", "-sws_flags",
            "+accurate_rnd+bitexact", "-color_range", "tv", "-colorspace", "bt709", "-color_primaries", "bt709",
            "-color_trc", "bt709", "-fflags", "+bitexact", "-flags:v", "+bitexact", "-map_metadata", "-1", "-bsf:v",
            "filter_units=remove_types=6", "-movflags", "+faststart", "-f", "mp4",
            // With the prefix, a path that begins with a dash or looks like a protocol is taken as a file.
            "file:" + path};
}

/// Returns the options if a video can be made with them, and throws otherwise.
VideoOptions checked(VideoOptions options) {
    if (options.size.width <= 0 || options.size.height <= 0 || options.frameRate.numerator <= 0)
        throw std::logic_error(fmt::format("video: {} x {} pixels at {} frames a second", options.size.width,
                                           options.size.height, options.frameRate.text()));
    requireEncoder(options);
    return options;
}

/// Copies an image's pixels to `bytes`, with the last column or row repeated if the width or height is odd. Returns
/// `bytes`.
const std::vector<std::uint8_t>& padded(const Image& image, std::vector<std::uint8_t>& bytes) {
    const auto row = static_cast<std::ptrdiff_t>(3 * image.width);
    bytes.clear();
    for (int y = 0; y < even(image.height); ++y) {
        const auto from = image.rgb.begin() + row * std::min(y, image.height - 1);
        bytes.insert(bytes.end(), from, from + row);
        if (image.width % 2 != 0) bytes.insert(bytes.end(), from + row - 3, from + row);
    }
    return bytes;
}

}  // namespace

void requireEncoder(const VideoOptions& options) {
    ChildProcess probe =
        started({options.ffmpeg, "-hide_banner", "-loglevel", "error", "-h", "encoder=libx264"}, options);
    const std::string ended = probe.wait();
    // Pages of options follow the first line. Under a limit on the size of files ffmpeg is killed while it writes them.
    const std::string answer = probe.firstLine();
    if (answer.find("Encoder libx264") != std::string::npos) return;
    if (!ended.empty()) throw SystemError(fmt::format("{} ended with {}: {}", options.ffmpeg, ended, answer));
    throw SystemError(fmt::format("{} has no libx264 encoder; install an ffmpeg that has one", options.ffmpeg));
}

VideoWriter::VideoWriter(VideoOptions options)
    : options_(checked(std::move(options))),
      file_(options_.path),
      process_(commandLine(options_, file_.temporaryPath().string()), options_.progressTimeout,
               file_.temporaryPath().string()) {
    file_.removeAbandoned();
}

void VideoWriter::fail(const std::string& ended) const {
    // An error is one line of this program's.
    std::string messages = process_.output();
    for (std::size_t at = 0; (at = messages.find('\n', at)) != std::string::npos; at += 2)
        messages.replace(at, 1, "; ");
    throw SystemError(fmt::format("cannot write {}: {} ended with {}{}{}", options_.path, options_.ffmpeg,
                                  ended.empty() ? "exit status 0 too early" : ended, messages.empty() ? "" : ": ",
                                  messages));
}

void VideoWriter::add(const Image& image) {
    const PictureSize size = options_.size;
    if (image.width != size.width || image.height != size.height || image.rgb.size() != image.byteCount()) {
        throw std::logic_error(fmt::format("video: a frame of {} x {} pixels for {} x {}", image.width, image.height,
                                           size.width, size.height));
    }
    const bool isEven = size.width % 2 == 0 && size.height % 2 == 0;
    if (!process_.write(isEven ? image.rgb : padded(image, padded_))) fail(process_.wait());
}

void VideoWriter::finish() {
    const std::string ended = process_.wait();
    if (!ended.empty()) fail(ended);
    file_.commit();
}

}  // namespace render
