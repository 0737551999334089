// Runs ffmpeg to encode a video: its command line, the pixels that are sent to it, and its errors.
#include "render/output/video.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <stdexcept>
#include <string_view>
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

using Arguments = std::vector<std::string>;

/// What a kind of video is to ffmpeg.
struct KindInfo {
    std::string_view extension;
    const char* encoder;
    const char* muxer;
};

const KindInfo& infoOf(VideoKind kind) {
    static constexpr std::array<KindInfo, 6> kInfos = {{{".mp4", "libx264", "mp4"},
                                                        {".mkv", "libx264", "matroska"},
                                                        {".webm", "libvpx-vp9", "webm"},
                                                        {".gif", "gif", "gif"},
                                                        {".webp", "libwebp_anim", "webp"},
                                                        {".png", "apng", "apng"}}};
    return kInfos.at(static_cast<std::size_t>(kind));
}

/// The kind of the video, which checked() has made sure of.
VideoKind kindOf(const VideoOptions& options) {
    return videoKindOf(options.path).value();
}

/// Whether the kind is encoded as yuv420p, which has one color for two by two pixels.
bool hasHalvedColors(VideoKind kind) {
    return kind == VideoKind::mp4 || kind == VideoKind::mkv || kind == VideoKind::webm;
}

/// The size of the frames that ffmpeg gets, in pixels.
PictureSize encodedSize(const VideoOptions& options) {
    if (!hasHalvedColors(kindOf(options))) return options.size;
    return {even(options.size.width), even(options.size.height)};
}

/// The filter and the settings of the encoder. The reasons for them:
///  - Colors: without the conversion to BT.709 and its tags, ffmpeg assumes BT.601 and colors shift. The pixel
///    format yuv420p requires an even width and height.
///  - No encoder settings in an H.264 stream (filter_units), so that its bytes are the same on any processor.
///  - Speed: superfast and realtime, because the encoder shares the processor with the drawing. Without B-frames and
///    weighted prediction H.264 takes a quarter less time (measured: mp4_ms of `globular study pictures`, 10,000
///    metaballs at 1280 x 720) for a quarter more bytes (`globular render splash --size 1280x720 --frames 40-69
///    --video`).
///  - A GIF has a palette for each frame: for one palette of all frames ffmpeg would keep the whole video in memory.
///    The Bayer pattern of its dither stays in place from frame to frame. Browsers show a frame for a tenth of a second
///    if it asks for less than a fiftieth, so that a GIF has at most 50 frames a second.
///  - WebP: quality 85 has no visible artifacts at the edges of particles (chosen).
Arguments encoding(const VideoOptions& options) {
    const std::string scale = "scale=in_range=full:out_range=tv:out_color_matrix=bt709:flags=accurate_rnd+bitexact";
    const std::string slower = options.frameRate.numerator > 50 * options.frameRate.denominator ? "fps=50," : "";
    Arguments arguments;
    switch (kindOf(options)) {
        case VideoKind::mp4:
        case VideoKind::mkv:
            arguments = {"-vf",          scale,       "-preset", "superfast", "-bf",    "0",
                         "-x264-params", "weightp=0", "-crf",    "20",        "-bsf:v", "filter_units=remove_types=6"};
            break;
        case VideoKind::webm:
            arguments = {"-vf", scale, "-deadline", "realtime", "-cpu-used", "6", "-crf", "30", "-b:v", "0"};
            break;
        case VideoKind::gif:
            return {"-vf",
                    slower +
                        "split[a][b];[a]palettegen=stats_mode=single[palette];"
                        "[b][palette]paletteuse=new=1:dither=bayer:bayer_scale=5",
                    "-loop", "0"};
        case VideoKind::webp:
            return {"-pix_fmt", "bgra", "-quality", "85", "-loop", "0"};
        case VideoKind::png:
            return {"-pix_fmt", "rgb24", "-pred", "mixed", "-plays", "0"};
    }
    for (const char* argument : {"-pix_fmt", "yuv420p", "-sws_flags", "+accurate_rnd+bitexact", "-color_range", "tv",
                                 "-colorspace", "bt709", "-color_primaries", "bt709", "-color_trc", "bt709"})
        arguments.emplace_back(argument);
    if (kindOf(options) == VideoKind::mp4) arguments.insert(arguments.end(), {"-movflags", "+faststart"});
    return arguments;
}

/// The arguments that start ffmpeg. Muxing is bit-exact and the number of encoder threads, on which the bytes depend,
/// is fixed, so that the bytes are the same on any processor. Without -xerror, a failure to write the end of the file
/// would count as success.
Arguments commandLine(const VideoOptions& options, const std::string& path) {
    const PictureSize size = encodedSize(options);
    const KindInfo& kind = infoOf(kindOf(options));
    Arguments arguments = {options.ffmpeg};
    arguments.insert(arguments.end(),
                     {"-hide_banner", "-loglevel", "error", "-xerror", "-nostdin", "-y", "-f", "rawvideo", "-pix_fmt",
                      "rgb24", "-video_size", fmt::format("{}x{}", size.width, size.height), "-framerate",
                      options.frameRate.text(), "-i", "-", "-c:v", kind.encoder});
    for (const std::string& argument : encoding(options)) arguments.push_back(argument);
    // With the prefix, a path that begins with a dash or looks like a protocol is taken as a file.
    arguments.insert(arguments.end(), {"-threads", "2", "-fflags", "+bitexact", "-flags:v", "+bitexact",
                                       "-map_metadata", "-1", "-f", kind.muxer, "file:" + path});
    return arguments;
}

/// Returns the options if a video can be made with them, and throws otherwise.
VideoOptions checked(VideoOptions options) {
    if (options.size.width <= 0 || options.size.height <= 0 || options.frameRate.numerator <= 0 ||
        !videoKindOf(options.path))
        throw std::logic_error(fmt::format("video: {}, {} x {} pixels at {} frames a second", options.path,
                                           options.size.width, options.size.height, options.frameRate.text()));
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

std::optional<VideoKind> videoKindOf(const std::string& path) {
    std::string extension = std::filesystem::path(path).extension().string();
    for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    for (const VideoKind kind :
         {VideoKind::mp4, VideoKind::mkv, VideoKind::webm, VideoKind::gif, VideoKind::webp, VideoKind::png})
        if (infoOf(kind).extension == extension) return kind;
    return std::nullopt;
}

void requireEncoder(const VideoOptions& options) {
    const KindInfo& kind = infoOf(kindOf(options));
    ChildProcess probe = started(
        {options.ffmpeg, "-hide_banner", "-loglevel", "error", "-h", fmt::format("encoder={}", kind.encoder)}, options);
    const std::string ended = probe.wait();
    // Pages of options follow the first line. Under a limit on the size of files ffmpeg is killed while it writes them.
    const std::string answer = probe.firstLine();
    if (answer.starts_with(fmt::format("Encoder {}", kind.encoder))) return;
    if (!ended.empty()) throw SystemError(fmt::format("{} ended with {}: {}", options.ffmpeg, ended, answer));
    throw SystemError(
        fmt::format("{} has no {} encoder, which a {} file needs; install an ffmpeg that has one (Debian: ffmpeg)",
                    options.ffmpeg, kind.encoder, kind.extension));
}

VideoWriter::VideoWriter(VideoOptions options)
    : options_(checked(std::move(options))),
      file_(options_.path),
      process_(commandLine(options_, file_.temporaryPath().string()), options_.progressTimeout,
               file_.temporaryPath().string()) {
    file_.removeAbandoned();
    process_.stopWhen(options_.mustStop);
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
    const PictureSize wanted = encodedSize(options_);
    const bool isPadded = wanted.width != size.width || wanted.height != size.height;
    if (!process_.write(isPadded ? padded(image, padded_) : image.rgb)) fail(process_.wait());
}

void VideoWriter::finish() {
    const std::string ended = process_.wait();
    if (!ended.empty()) fail(ended);
    file_.commit();
}

}  // namespace render
