// Frames to an MP4 by the ffmpeg program: started with an argument vector, fed raw pixels through a pipe. Used by
// tools/.
#pragma once

#include <chrono>
#include <memory>
#include <string>

#include "render/output/child_process.h"
#include "render/picture/image.h"
#include "render/picture/view.h"

namespace render {

struct VideoOptions {
    std::string path;  ///< the finished film; written to path + ".partial" and renamed when whole
    PictureSize size;
    int fps = 30;
    std::string ffmpeg = "ffmpeg";                              ///< the program, looked up on PATH
    std::chrono::duration<double> patience = kProgressTimeout;  ///< with a program that does not go on, s
};

/// Throws SystemError: ffmpeg cannot be started, or has no libx264. Distributions that leave it out of ffmpeg let a
/// film fail only after the first frames.
void requireEncoder(const VideoOptions& options);

/// Writes one film: H.264, yuv420p, BT.709. Odd sizes are padded to even by repeating the last column or row.
/// Holds:  the same frames give the same bytes on any machine: the encoder always has two threads.
class VideoWriter {
 public:
    /// Throws SystemError: as requireEncoder, or the file cannot be written.
    explicit VideoWriter(VideoOptions options);
    /// Without finish() the film is given up: ffmpeg is ended and the partial file removed.
    ~VideoWriter();
    VideoWriter(const VideoWriter&) = delete;
    VideoWriter& operator=(const VideoWriter&) = delete;

    /// The next frame, of the size given. Throws SystemError with ffmpeg's last words when it has died.
    void add(const Image& image);

    /// Completes the film and renames it. Throws SystemError with ffmpeg's last words when it fails.
    void finish();

 private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

}  // namespace render
