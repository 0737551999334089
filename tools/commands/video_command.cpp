// globular video: frames that exist become a video; a gap is refused.
#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "render/output/png.h"
#include "render/output/video.h"
#include "render/picture/system_error.h"
#include "scenes/text/input_error.h"
#include "tools/commands/commands.h"
#include "tools/run/scene_options.h"
#include "tools/system/json.h"
#include "tools/system/output_file.h"
#include "tools/system/parse_number.h"
#include "tools/system/progress.h"

namespace tools {
namespace {

namespace fs = std::filesystem;

struct VideoCommandOptions {
    RunOptions run;
    std::string folder;
    std::string output;
    int fps = 0;
};

std::string frameName(int number) {
    return fmt::format("frame-{:05}.png", number);
}

/// The numbers of the frames in a folder, in order.
std::vector<int> frameNumbers(const fs::path& folder) {
    std::error_code error;
    std::vector<int> numbers;
    for (const auto& entry : fs::directory_iterator(folder, error)) {
        const std::string stem = entry.path().stem().string();
        if (entry.path().extension() != ".png" || !stem.starts_with("frame-")) continue;
        const std::optional<int> number = parseNumber(std::string_view(stem).substr(std::string_view("frame-").size()));
        if (number && *number >= 0 && entry.path().filename() == frameName(*number)) numbers.push_back(*number);
    }
    if (error) throw render::SystemError(fmt::format("cannot read folder {}: {}", folder.string(), error.message()));
    std::sort(numbers.begin(), numbers.end());
    return numbers;
}

void refuseGaps(const fs::path& folder, const std::vector<int>& numbers) {
    if (numbers.empty())
        throw render::SystemError(fmt::format("{} holds no frames (frame-00000.png, ...)", folder.string()));
    for (std::size_t k = 1; k < numbers.size(); ++k)
        if (numbers[k] != numbers[k - 1] + 1)
            throw render::SystemError(fmt::format("{} is missing; frames {} and {} exist",
                                                  (folder / frameName(numbers[k - 1] + 1)).string(), numbers[k - 1],
                                                  numbers[k]));
}

/// The rate of the run that wrote the frames, or 30 where nothing says.
int rateOf(const VideoCommandOptions& options) {
    if (options.fps > 0) return options.fps;
    const fs::path run = fs::path(options.folder) / "run.json";
    if (!fs::exists(run)) return 30;
    const nlohmann::json json = sortedJsonOrNull(readFile(run));
    if (!json.is_object() || !json.contains("fps") || !json["fps"].is_number_integer() || json["fps"] < 1 ||
        json["fps"] > 240)
        throw render::SystemError(fmt::format("{} names no frame rate; give one with --fps", run.string()));
    return json["fps"].get<int>();
}

void encode(const VideoCommandOptions& options) {
    const fs::path folder = options.folder;
    const std::vector<int> numbers = frameNumbers(folder);
    refuseGaps(folder, numbers);
    if (fs::path(options.output).has_parent_path()) createFolder(fs::path(options.output).parent_path());

    const auto read = [&](int number) {
        const fs::path path = folder / frameName(number);
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
                                                  (folder / frameName(number)).string(), image.width, image.height,
                                                  first.width, first.height));
        writer.add(image);
        progress.frameDone(number, static_cast<double>(number) / video.fps);
    }
    writer.finish();
    if (options.run.json)
        printJson(Json{{"event", "done"}, {"video", options.output}, {"frames", numbers.size()}});
    else if (!options.run.quiet)
        fmt::print("{} frames in {}\n", numbers.size(), options.output);
}

}  // namespace

void addVideoCommand(const Command& program) {
    const Command command = program.command("video", "frames that exist to a video; refuses gaps");
    const auto options = std::make_shared<VideoCommandOptions>();
    command.option("DIR", options->folder, "folder with frame-00000.png, ...").required();
    command.option("-o,--output", options->output, "the video to write").required().of("FILE.mp4");
    command.option("--fps", options->fps, "frames per second (default: that of run.json, else 30)").within(1, 240);
    addTo(command, options->run);
    command.example("globular video out/liquid -o out/liquid.mp4");
    command.run([options] { encode(*options); });
}

}  // namespace tools
