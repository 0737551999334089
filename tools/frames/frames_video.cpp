// One picture is in memory at a time.
#include "tools/frames/frames_video.h"

#include <fmt/format.h>

#include "render/output/png.h"
#include "render/output/video.h"
#include "render/picture/system_error.h"
#include "scenes/text/frame_rate.h"
#include "tools/frames/frame_names.h"
#include "tools/system/output_file.h"

namespace tools {

void makeVideo(const FramesVideo& video, Progress& progress) {
    createFolderOf(video.path);
    const auto pathOf = [&](int number) { return video.folder / kPictureNames.fileName(number); };
    const auto read = [&](int number) { return render::decodePng(readFile(pathOf(number)), pathOf(number).string()); };
    const render::Image first = read(video.numbers.front());
    render::VideoOptions options;
    options.path = video.path;
    options.size = {first.width, first.height};
    options.frameRate = video.rate;
    render::VideoWriter writer(options);
    for (const int number : video.numbers) {
        const render::Image image = read(number);
        if (image.width != first.width || image.height != first.height)
            throw render::SystemError(fmt::format("{} is {}x{}, the frames before it are {}x{}",
                                                  pathOf(number).string(), image.width, image.height, first.width,
                                                  first.height));
        writer.add(image);
        progress.frameDone(number, video.rate.timeOf(number));
    }
    const Progress::Work work(progress, "completing the video");
    writer.finish();
}

std::optional<render::FrameRate> frameRateIn(const Json& json) {
    const auto rate = scenes::frameRateFrom(json.is_string() ? json.get<std::string>() : compactText(json));
    const bool isAllowed = rate && rate->framesIn(1.0) >= 1.0 && rate->framesIn(1.0) <= 240.0;
    return isAllowed ? rate : std::nullopt;
}

}  // namespace tools
