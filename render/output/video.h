// Encodes frames to a video with the program ffmpeg, which is started without a shell and reads raw pixels from its
// input. Used by tools/run/render_loop.cpp and the video command.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "render/output/atomic_file.h"
#include "render/output/child_process.h"
#include "render/picture/image.h"
#include "render/picture/view.h"

namespace render {

/// The kinds of videos. GIF, WebP and PNG are animated pictures that repeat without end; a PNG of one frame is an
/// ordinary picture.
enum class VideoKind { mp4, mkv, webm, gif, webp, png };

/// The extensions that name the kinds, for messages.
inline constexpr const char* kVideoExtensions = ".mp4, .mkv, .webm, .gif, .webp or .png";

/// The kind of video that a file name asks for by its extension, in upper or lower case; nothing for any other name.
std::optional<VideoKind> videoKindOf(const std::string& path);

struct VideoOptions {
    std::string path;  ///< path of the video, which has a kind; the file appears there when it is whole
    PictureSize size;
    FrameRate frameRate = {};
    std::string ffmpeg = "ffmpeg";  ///< the program, looked up on PATH
    std::chrono::duration<double> progressTimeout =
        kProgressTimeout;  ///< time without progress after which ffmpeg is killed, s
    std::function<bool()> mustStop =
        {};  ///< kills ffmpeg, as soon as it returns true, for which add() and finish() fail
};

/// Asks ffmpeg for the encoder of the video's kind, because an ffmpeg without it fails only after the first frames.
/// @throws SystemError when ffmpeg cannot be started or does not have the encoder
void requireEncoder(const VideoOptions& options);

/// Writes one video: H.264 in MP4 and MKV, VP9 in WebM, both yuv420p in BT.709, or an animated picture. An odd width or
/// height is padded to even for yuv420p by repeating the last column or row. The same frames give the same bytes on any
/// machine, because the encoder always has two threads. Without finish(), the destructor kills ffmpeg and removes the
/// temporary file.
class VideoWriter {
 public:
    /// @throws SystemError when ffmpeg cannot be started or has no encoder of the kind, or when the file cannot be
    /// created
    explicit VideoWriter(VideoOptions options);

    /// Appends a frame to the video.
    /// @param image  must have the size given in the options
    /// @throws SystemError with the end of ffmpeg's output when ffmpeg has ended
    void add(const Image& image);

    /// Waits until ffmpeg has completed the video, and gives the file its final name.
    /// @throws SystemError with the end of ffmpeg's output when ffmpeg fails
    void finish();

 private:
    [[noreturn]] void fail(const std::string& ended) const;

    VideoOptions options_;
    AtomicFile file_;
    ChildProcess process_;              // the ffmpeg process, destroyed and so killed before its file is removed
    std::vector<std::uint8_t> padded_;  // a frame padded to an even width and height, kept to reuse its memory
};

}  // namespace render
