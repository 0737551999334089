// Makes a video of the pictures in a folder. Used by `video` and `assemble`.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "render/picture/view.h"
#include "tools/system/json.h"
#include "tools/system/progress.h"

namespace tools {

struct FramesVideo {
    std::filesystem::path folder;
    std::vector<int> numbers;  ///< of the frames, in increasing order; at least one
    render::FrameRate rate;
    std::string path;  ///< of the video, whose name has an extension of a kind; its folder is created if needed
};

/// Makes the video. It has the same bytes as one that a run made of the same frames.
/// @param progress  is told of each frame
/// @throws render::SystemError if a picture cannot be read or has another size than the first, or ffmpeg fails; a video
/// of that name is then unchanged
void makeVideo(const FramesVideo& video, Progress& progress);

/// The frame rate that a number or a text spells, if a scene may have it.
std::optional<render::FrameRate> frameRateIn(const Json& json);

}  // namespace tools
