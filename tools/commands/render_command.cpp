// globular render: simulates and draws a scene, or draws it from states that were simulated before, and writes PNG
// frames, run.json and a video.
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <iterator>
#include <memory>
#include <optional>

#include "engine/state/simulation.h"
#include "render/output/video.h"
#include "scenes/text/input_error.h"
#include "tools/commands/commands.h"
#include "tools/frames/chunk.h"
#include "tools/frames/frame_names.h"
#include "tools/frames/simulated_states.h"
#include "tools/run/frame_folder.h"
#include "tools/run/render_loop.h"
#include "tools/run/run_warnings.h"
#include "tools/run/state_sequence.h"
#include "tools/system/command_files.h"
#include "tools/system/output_file.h"
#include "tools/system/process.h"

namespace tools {
namespace {

namespace fs = std::filesystem;

struct RenderOptions {
    RunOptions run;
    SceneOptions scene;
    DrawOptions draw;
    FolderOptions folder;
    std::string video;
    std::string frames;
    std::string chunk;  ///< part of the frames, as parseChunk() takes it; empty: all of them
    std::vector<std::string> formats = {std::string(render::pictureFormats().front().name)};
    std::string states;  ///< folder of states to draw; empty: the scene is simulated
    bool estimatesErrors = true;
};

bool pipesFrames(const RenderOptions& options) {
    return options.folder.path == kStandardStream;
}

/// The last lines of a run that was drawn from states.
std::string drawnSummaryOf(const RenderOptions& options, const RunReport& report) {
    const StageSeconds& seconds = report.seconds;
    return fmt::format(
        "{} frames {}{}\nfrom states in {}: up to {} particles, {:.1f} s (reading {:.1f}, drawing {:.1f}, encoding "
        "{:.1f}), "
        "state {}\n",
        report.frames, pipesFrames(options) ? "to standard output" : "in " + options.folder.path,
        options.video.empty() ? "" : ", video " + options.video, options.states, report.largestCount, seconds.all,
        seconds.reading, seconds.drawing, seconds.encoding, report.stateHash);
}

std::string summaryOf(const RenderOptions& options, const scenes::Scene& scene, const FinishedRun& run) {
    if (!options.states.empty()) return drawnSummaryOf(options, run.report);
    const StageSeconds& seconds = run.report.seconds;
    return fmt::format(
        "{} frames {}{}\n{} particles, {} steps, {:.1f} s (simulating {:.1f}, drawing {:.1f}, encoding {:.1f}), "
        "state {}\n{}",
        run.report.frames, pipesFrames(options) ? "to standard output" : "in " + options.folder.path,
        options.video.empty() ? "" : ", video " + options.video, engine::largestCount(run.simulation),
        run.simulation.steps.count, seconds.all, seconds.simulating, seconds.drawing, seconds.encoding,
        run.report.stateHash, troubleLine(scene, run.simulation));
}

/// The formats that are asked for, each once.
/// @throws scenes::InputError if OpenGL is to draw one that it cannot
/// @throws render::SystemError if a library is missing
std::vector<const render::PictureFormat*> formatsOf(const RenderOptions& options) {
    std::vector<const render::PictureFormat*> formats;
    for (const render::PictureFormat& format : render::pictureFormats()) {
        if (std::ranges::find(options.formats, format.name) == options.formats.end()) continue;
        render::requireFormat(format);
        if ((format.layers.color || format.layers.ids) && rendererOf(options.draw).isOpenGl)
            throw scenes::InputError(fmt::format("--format {}", format.name),
                                     "OpenGL draws rgb, depth and normal; the other formats are for --renderer cpu");
        formats.push_back(&format);
    }
    return formats;
}

/// Checks the outputs before anything is done.
/// @param states  that are drawn; nullptr: none
void checkOutputs(const RenderOptions& options, const scenes::Scene& scene, const SimulatedStates* states) {
    CommandFiles files{scene.files, {}, {}};
    if (states != nullptr) std::ranges::copy(states->files(), std::back_inserter(files.inputs));
    if (!options.video.empty()) {
        requireVideoName("--video", options.video);
        if (std::ranges::find(options.formats, render::pictureFormats().front().name) == options.formats.end())
            throw scenes::InputError("--video", "a video is made of finished pictures; add rgb to --format");
        files.outputs.push_back({"--video", options.video});
    }
    if (pipesFrames(options)) {
        requirePipedOutput(options.run);
        if (options.formats.size() > 1) throw scenes::InputError("-o -", "standard output takes one --format");
        if (options.folder.resume || options.folder.overwrite || options.folder.chunk)
            throw scenes::InputError("-o -", "--resume, --overwrite and --chunk are for a folder of frames");
    } else {
        files.folders.push_back({"-o", options.folder.path, isRunFile});
    }
    requireSeparate(files);
}

/// The frames that are to be drawn, and in the options the chunk that they are; nothing if the chunk is empty.
std::optional<FrameList> framesToDraw(RenderOptions& options, const scenes::Scene& scene) {
    const FrameList all = frameList(options.frames, scenes::frameCount(scene));
    if (options.chunk.empty()) return all;
    FolderOptions& folder = options.folder;
    const auto environment = [](const char* name) -> const char* { return std::getenv(name); };
    const bool isList = options.chunk == "list";
    folder.chunk = isList ? chunkOfList(all) : parseChunk(options.chunk, environment);
    folder.allFrames = listText(all.numbers);
    if (!options.video.empty())
        throw scenes::InputError("--video",
                                 "a chunk has only a part of the frames; `globular assemble` makes the video");
    if (folder.overwrite)
        throw scenes::InputError("--overwrite",
                                 "chunks that start one after the other would remove each other's frames; remove the "
                                 "folder before the first one");
    return isList ? all : framesOf(all, *folder.chunk);
}

void render(RenderOptions options) {
    const scenes::Scene scene = load(options.scene, overridesOf(options.draw));
    const std::string name = runName(options.scene);
    if (options.folder.path.empty()) options.folder.path = (fs::path("out") / name).string();
    const auto frames = framesToDraw(options, scene);
    if (!frames)
        return printResult(options.run, {{"event", "done"}, {"folder", options.folder.path}, {"run", nullptr}},
                           fmt::format("chunk {} is empty: there are not so many frames\n", options.chunk));
    RenderJob job{drawJob(scene, options.draw, options.run, name),
                  *frames,
                  options.folder,
                  options.video,
                  pipesFrames(options),
                  options.estimatesErrors};
    job.formats = formatsOf(options);
    if (job.pipesFrames) job.folder.reset();
    const std::optional<SimulatedStates> states = openStates(options.states, scene, job.frames);
    if (states) job.states = &*states;
    checkOutputs(options, scene, job.states);
    warnOfSharpness(options.scene, job);

    // How the simulation starts is none of the concerns of a run that does not simulate.
    if (!states)
        warnOfStart(options.scene, scene, job.threads);
    else if (options.scene.isStrict)
        refuse(scene.warnings);
    if (!options.video.empty()) createFolderOf(options.video);
    const FinishedRun run = renderFrames(job);
    requireComplete(run.report, options.folder.path);
    const std::string summary = summaryOf(options, scene, run);
    if (!job.pipesFrames)
        printResult(options.run, {{"event", "done"}, {"folder", options.folder.path}, {"run", run.json}}, summary);
    else if (!options.run.quiet)
        printToStderr(summary);
}

}  // namespace

void addRenderCommand(CLI::App& program) {
    CLI::App& command = *program.add_subcommand("render", "simulate and draw a scene: PNG frames, run.json, a video");
    const auto options = std::make_shared<RenderOptions>();
    addTo(command, options->scene);
    addStrictFlag(command, options->scene);
    addTo(command, options->folder,
          "folder for frames and run.json, or - for frames as PNGs on standard output (default: out/NAME)");
    addFormats(command, render::pictureFormats(), options->formats);
    command
        .add_option("--video", options->video,
                    fmt::format("also write a video; the name must end in {}", render::kVideoExtensions))
        ->type_name("FILE");
    command.add_option("--frames", options->frames, std::string("draw only ") + kFrameListHelp)->type_name("FRAMES");
    command
        .add_option(
            "--states", options->states,
            "draw the states that `globular simulate` has written of this scene, without simulating; title, "
            "duration, colors, what is drawn of obstacles, and [camera], [look], [overlay] and [still] may differ")
        ->type_name("DIR");
    command.add_option("--chunk", options->chunk, kChunkHelp)->type_name("I/N");
    addTo(command, options->draw);
    addErrorFlag(command, options->estimatesErrors);
    addTo(command, options->run);
    command.footer(std::string(kErrorSampleNotes) +
                   "Example: globular render liquid -o out/liquid --video out/liquid.mp4\n"
                   "         globular render liquid --states out/liquid-states --size 1920x1080 -o out/large\n"
                   "         globular render liquid --format rgba,depth,id -o out/layers");
    command.callback([options] { render(*options); });
}

}  // namespace tools
