// globular video: makes a video of the frames in a folder. A missing frame is an error.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <vector>

#include "render/output/png.h"
#include "render/output/video.h"
#include "render/picture/system_error.h"
#include "tools/commands/commands.h"
#include "tools/run/frame_folder.h"
#include "tools/system/json.h"
#include "tools/system/output_file.h"
#include "tools/system/progress.h"

namespace tools {
namespace {

namespace fs = std::filesystem;

struct EncodeOptions {
    RunOptions run;
    std::string folder;
    std::string output;
    int fps = 0;
};

/// The numbers of the frames in a folder, in order.
/// @throws render::SystemError if there are none or one between them is missing
std::vector<int> frameNumbers(const fs::path& folder) {
    std::vector<int> numbers;
    for (const fs::path& file : filesIn(folder))
        if (const auto number = kPictureNames.frameOf(file)) numbers.push_back(*number);
    if (numbers.empty())
        throw render::SystemError(fmt::format("{} holds no frames (frame-00000.png, ...)", folder.string()));
    std::sort(numbers.begin(), numbers.end());
    for (std::size_t k = 1; k < numbers.size(); ++k)
        if (numbers[k] != numbers[k - 1] + 1)
            throw render::SystemError(fmt::format("{} is missing; frames {} and {} exist",
                                                  (folder / kPictureNames.fileName(numbers[k - 1] + 1)).string(),
                                                  numbers[k - 1], numbers[k]));
    return numbers;
}

/// Frame rate of the video, in frames per second: from --fps, or else from run.json, or 30 if there is no run.json.
int rateOf(const EncodeOptions& options) {
    if (options.fps > 0) return options.fps;
    const fs::path run = fs::path(options.folder) / "run.json";
    if (!fs::exists(run)) return 30;
    const Json json = Json::parse(readFile(run), nullptr, false);
    if (!json.is_object() || !json.contains("fps") || !json["fps"].is_number_integer() || json["fps"] < 1 ||
        json["fps"] > 240)
        throw render::SystemError(fmt::format("{} has no frame rate; give one with --fps", run.string()));
    return json["fps"].get<int>();
}

void encode(const EncodeOptions& options) {
    const fs::path folder = options.folder;
    const std::vector<int> numbers = frameNumbers(folder);
    if (fs::path(options.output).has_parent_path()) createFolder(fs::path(options.output).parent_path());

    const auto read = [&](int number) {
        const fs::path path = folder / kPictureNames.fileName(number);
        return render::decodePng(readFile(path), path.string());
    };
    const render::Image first = read(numbers.front());
    render::VideoOptions video;
    video.path = options.output;
    video.size = {first.width, first.height};
    video.fps = rateOf(options);
    render::VideoWriter writer(video);
    Progress progress(folder.string(), static_cast<int>(numbers.size()), options.run.verbosity());
    for (const int number : numbers) {
        const render::Image image = read(number);
        if (image.width != first.width || image.height != first.height)
            throw render::SystemError(fmt::format("{} is {}x{}, the frames before it are {}x{}",
                                                  (folder / kPictureNames.fileName(number)).string(), image.width,
                                                  image.height, first.width, first.height));
        writer.add(image);
        progress.frameDone(number, static_cast<double>(number) / video.fps);
    }
    writer.finish();
    printResult(options.run, {{"event", "done"}, {"video", options.output}, {"frames", numbers.size()}},
                fmt::format("{} frames in {}\n", numbers.size(), options.output));
}

}  // namespace

void addVideoCommand(CLI::App& program) {
    CLI::App& command = *program.add_subcommand("video", "frames that exist to a video; refuses gaps");
    const auto options = std::make_shared<EncodeOptions>();
    command.add_option("DIR", options->folder, "folder with frame-00000.png, ...")->required();
    command.add_option("-o,--output", options->output, "the video to write")->required()->type_name("FILE.mp4");
    command.add_option("--fps", options->fps, "frames per second (default: that of run.json, else 30)")
        ->check(CLI::Range(1, 240));
    addTo(command, options->run);
    command.footer("Example: globular video out/liquid -o out/liquid.mp4");
    command.callback([options] { encode(*options); });
}

}  // namespace tools
