// Decodes the frames of a video one by one with the program ffmpeg, through a pipe. Used by tools/compare.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "render/output/child_process.h"
#include "render/picture/image.h"

namespace render {

/// The frames of a video in their order. The destructor ends ffmpeg.
class VideoReader {
 public:
    /// @throws SystemError when ffmpeg cannot be started
    explicit VideoReader(std::string path);

    /// The next frame, or nothing after the last.
    /// @param whileWaiting  called at least ten times a second while ffmpeg decodes; ends the wait by throwing
    /// @throws SystemError with ffmpeg's own words when it cannot decode the video to its end
    std::optional<Image> next(const std::function<void()>& whileWaiting);

 private:
    std::string path_;
    ChildProcess ffmpeg_;
};

}  // namespace render
