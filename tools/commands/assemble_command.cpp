// globular assemble: checks that the chunks of a run have drawn all of its frames, joins their manifests, and makes the
// video.
#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "render/output/atomic_file.h"
#include "render/output/video.h"
#include "render/picture/system_error.h"
#include "scenes/text/input_error.h"
#include "tools/commands/commands.h"
#include "tools/frames/folder_lock.h"
#include "tools/frames/frame_list.h"
#include "tools/frames/frame_names.h"
#include "tools/frames/frames_video.h"
#include "tools/frames/joined_frames.h"
#include "tools/system/command_files.h"
#include "tools/system/output_file.h"
#include "tools/system/process.h"

namespace tools {
namespace {

namespace fs = std::filesystem;

struct AssembleOptions {
    RunOptions run;
    std::string folder;
    std::string frames;  ///< that have to be there, as --frames takes them; empty: those that were asked for
    std::string video;   ///< empty: none
    bool printsMissing = false;
};

/// Frames are numbered below this. Chosen: a scene of a million seconds at 240 frames a second has fewer.
constexpr int kMostFrames = 1 << 28;

/// The exit code where frames are missing.
constexpr int kIncompleteCode = 1;

/// Says which frames are missing or damaged, and how to draw them.
/// @throws ExitStatus if there are any
void requireWhole(const AssembleOptions& options, const JoinedFrames& joined) {
    const std::vector<int> toDraw = joined.toDraw();
    if (options.run.json && (options.printsMissing || !toDraw.empty()))
        printJson({{"event", "missing"}, {"frames", listText(toDraw)}, {"count", toDraw.size()}});
    if (options.printsMissing && !options.run.json && !toDraw.empty()) printText(listText(toDraw) + "\n");
    if (toDraw.empty()) return;
    std::string message;
    const std::size_t all = joined.whole.size() + toDraw.size();
    if (!joined.missing.empty())
        message = fmt::format("{} of {} frames of {} are missing: {}", joined.missing.size(), all, options.folder,
                              listText(joined.missing));
    if (!joined.damaged.empty())
        message += fmt::format("{}{} of {} frames of {} are damaged: {}", message.empty() ? "" : "\n",
                               joined.damaged.size(), all, options.folder, listText(joined.damaged));
    message += "\ndraw them with the command that draws the others, with --resume";
    throw ExitStatus(kIncompleteCode, options.printsMissing ? "" : message);
}

/// Checks the name of the video before anything is done.
void checkOutput(const AssembleOptions& options) {
    if (options.video.empty()) return;
    requireVideoName("-o", options.video);
    CommandFiles files{{}, {{"-o", options.video}}, {}};
    for (const fs::path& file : filesIn(options.folder))
        if (isRunFile(file)) files.inputs.push_back(file);
    requireSeparate(files);
}

/// Writes manifest.json and run.json as a run of all frames would have left them, as far as chunks know.
void writeJoined(const fs::path& folder, const JoinedFrames& joined) {
    const FolderLock lock(folder);
    if (!joined.chunks.empty()) writeFile(folder / "run.json", indentedText(joinedReport(joined)));
    writeFile(folder / manifestName(std::nullopt), encodeManifest(joined.manifest));
    // No chunk has these open while the folder is locked.
    render::removeAbandonedFiles(folder, isRunFile);
    for (const fs::path& file : filesIn(folder))
        if (isChunkLock(file)) fs::remove(file);
}

void writeVideo(const AssembleOptions& options, const JoinedFrames& joined) {
    const auto rate = frameRateIn(joined.manifest.identity.value("fps", Json()));
    if (!rate) throw render::SystemError(fmt::format("the manifests in {} have no frame rate", options.folder));
    Progress progress(options.folder, static_cast<int>(joined.whole.size()), options.run.verbosity());
    makeVideo({options.folder, joined.whole, *rate, options.video}, progress);
}

/// The frames that --frames names; nothing without it.
std::optional<FrameList> wantedFrames(const AssembleOptions& options) {
    if (options.frames.empty()) return std::nullopt;
    const bool isOpen = options.frames.ends_with('-') || options.frames.find("-,") != std::string::npos ||
                        options.frames.find("-:") != std::string::npos;
    if (isOpen)
        throw scenes::InputError("--frames " + options.frames,
                                 "assemble does not know the scene's last frame; name it");
    return frameList(options.frames, kMostFrames);
}

void assemble(const AssembleOptions& options) {
    if (!fs::is_directory(options.folder)) throw render::SystemError(fmt::format("{} is not a folder", options.folder));
    checkOutput(options);
    const JoinedFrames joined = joinFrames(options.folder, wantedFrames(options));
    requireWhole(options, joined);
    if (options.printsMissing) return;
    if (!options.video.empty() && !joined.manifest.hasFrames)
        throw scenes::InputError("-o " + options.video,
                                 fmt::format("{} has no finished pictures, which a video is made of; draw them with "
                                             "--format rgb",
                                             options.folder));
    if (const std::string warning = machineWarning(joined); !warning.empty()) printWarning(warning);
    writeJoined(options.folder, joined);
    if (!options.video.empty()) writeVideo(options, joined);
    printResult(options.run,
                {{"event", "done"},
                 {"folder", options.folder},
                 {"frames", joined.whole.size()},
                 {"chunks", joined.chunks.size()},
                 {"video", options.video.empty() ? Json(nullptr) : Json(options.video)}},
                fmt::format("{} frames in {} are whole{}{}\n", joined.whole.size(), options.folder,
                            joined.chunks.empty() ? "" : fmt::format(", of {} chunks", joined.chunks.size()),
                            options.video.empty() ? "" : ", video " + options.video));
}

}  // namespace

void addAssembleCommand(CLI::App& program) {
    CLI::App& command =
        *program.add_subcommand("assemble", "check and join the frames that chunks have drawn, and make their video");
    const auto options = std::make_shared<AssembleOptions>();
    command.add_option("DIR", options->folder, "folder that `globular render --chunk` has drawn into")->required();
    command
        .add_option("--frames", options->frames,
                    "the frames that have to be there, e.g. 0-119 (default: those that the chunks were asked for)")
        ->type_name("FRAMES");
    CLI::Option* const video =
        command
            .add_option("-o,--output", options->video,
                        fmt::format("the video to write; the name must end in {}", render::kVideoExtensions))
            ->type_name("FILE");
    command
        .add_flag("--print-missing", options->printsMissing,
                  "only print the frames that are missing or damaged, as --frames takes them; exit code 1 if any is")
        ->excludes(video);
    addTo(command, options->run);
    command.footer(
        "Compares every frame with the checksum that its chunk has recorded, and makes sure that all are of the same\n"
        "scene, size, quality, renderer and version. Until all frames that were asked for are whole it names those\n"
        "that are not and ends with exit code 1. Then it writes manifest.json and run.json, and the video: the same\n"
        "bytes as that of a run that was not shared out.\n"
        "Example: globular assemble out/liquid -o out/liquid.mp4");
    command.callback([options] { assemble(*options); });
}

}  // namespace tools
