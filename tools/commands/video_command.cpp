// globular video: makes a video of the frames in a folder. A missing frame is an error.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "render/output/png.h"
#include "render/output/video.h"
#include "render/picture/system_error.h"
#include "scenes/text/frame_rate.h"
#include "scenes/text/input_error.h"
#include "tools/commands/commands.h"
#include "tools/run/frame_folder.h"
#include "tools/system/command_files.h"
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
    std::string fps;
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

/// The frame rate that a text spells, if a scene may have it.
std::optional<render::FrameRate> rateFrom(const std::string& text) {
    const auto rate = scenes::frameRateFrom(text);
    const bool isAllowed = rate && rate->framesIn(1.0) >= 1.0 && rate->framesIn(1.0) <= 240.0;
    return isAllowed ? rate : std::nullopt;
}

/// Frame rate of the video: from --fps, or else from run.json, or 30 a second if there is no run.json.
render::FrameRate rateOf(const EncodeOptions& options) {
    if (!options.fps.empty()) {
        if (const auto rate = rateFrom(options.fps)) return *rate;
        throw scenes::InputError("--fps " + options.fps,
                                 "must be a whole number or a fraction such as 30000/1001, from 1 to 240");
    }
    const fs::path run = fs::path(options.folder) / "run.json";
    if (!fs::exists(run)) return {};
    const Json json = Json::parse(readFile(run), nullptr, false);
    const Json fps = json.is_object() ? json.value("fps", Json()) : Json();
    const auto rate = rateFrom(fps.is_string() ? fps.get<std::string>() : compactText(fps));
    if (!rate) throw render::SystemError(fmt::format("{} has no frame rate; give one with --fps", run.string()));
    return *rate;
}

void encode(const EncodeOptions& options) {
    const fs::path folder = options.folder;
    const render::FrameRate rate = rateOf(options);
    requireVideoName("-o", options.output);
    const std::vector<int> numbers = frameNumbers(folder);
    CommandFiles files{{}, {{"-o", options.output}}, {}};
    for (const fs::path& file : filesIn(folder))
        if (isRunFile(file)) files.inputs.push_back(file);
    requireSeparate(files);
    createFolderOf(options.output);

    const auto read = [&](int number) {
        const fs::path path = folder / kPictureNames.fileName(number);
        return render::decodePng(readFile(path), path.string());
    };
    const render::Image first = read(numbers.front());
    render::VideoOptions video;
    video.path = options.output;
    video.size = {first.width, first.height};
    video.frameRate = rate;
    {
        render::VideoWriter writer(video);
        Progress progress(folder.string(), static_cast<int>(numbers.size()), options.run.verbosity());
        for (const int number : numbers) {
            const render::Image image = read(number);
            if (image.width != first.width || image.height != first.height)
                throw render::SystemError(fmt::format("{} is {}x{}, the frames before it are {}x{}",
                                                      (folder / kPictureNames.fileName(number)).string(), image.width,
                                                      image.height, first.width, first.height));
            writer.add(image);
            progress.frameDone(number, rate.timeOf(number));
        }
        const Progress::Work work(progress, "completing the video");
        writer.finish();
    }
    printResult(options.run, {{"event", "done"}, {"video", options.output}, {"frames", numbers.size()}},
                fmt::format("{} frames in {}\n", numbers.size(), options.output));
}

}  // namespace

void addVideoCommand(CLI::App& program) {
    CLI::App& command = *program.add_subcommand("video", "frames that exist to a video; refuses gaps");
    const auto options = std::make_shared<EncodeOptions>();
    command.add_option("DIR", options->folder, "folder with frame-00000.png, ...")->required();
    command
        .add_option("-o,--output", options->output,
                    fmt::format("the video to write; the name must end in {}", render::kVideoExtensions))
        ->required()
        ->type_name("FILE");
    command
        .add_option("--fps", options->fps,
                    "frames per second, also as a fraction such as 30000/1001 (default: that of run.json, else 30)")
        ->type_name("RATE");
    addTo(command, options->run);
    command.footer("Example: globular video out/liquid -o out/liquid.mp4");
    command.callback([options] { encode(*options); });
}

}  // namespace tools
