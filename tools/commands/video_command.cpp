// globular video: makes a video of the frames in a folder. A missing frame is an error.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "render/output/video.h"
#include "render/picture/system_error.h"
#include "scenes/text/input_error.h"
#include "tools/commands/commands.h"
#include "tools/frames/frame_names.h"
#include "tools/frames/frames_video.h"
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

/// Frame rate of the video: from --fps, or else from run.json, or 30 a second if there is no run.json.
render::FrameRate rateOf(const EncodeOptions& options) {
    if (!options.fps.empty()) {
        if (const auto rate = frameRateIn(options.fps)) return *rate;
        throw scenes::InputError("--fps " + options.fps,
                                 "must be a whole number or a fraction such as 30000/1001, from 1 to 240");
    }
    const fs::path run = fs::path(options.folder) / "run.json";
    if (!fs::exists(run)) return {};
    const Json json = Json::parse(readFile(run), nullptr, false);
    const auto rate = frameRateIn(json.is_object() ? json.value("fps", Json()) : Json());
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
    {
        Progress progress(folder.string(), static_cast<int>(numbers.size()), options.run.verbosity());
        makeVideo({folder, numbers, rate, options.output}, progress);
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
