// globular render: simulates and draws a scene, and writes PNG frames, run.json and a video.
#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "engine/state/simulation.h"
#include "tools/commands/commands.h"
#include "tools/run/render_loop.h"
#include "tools/system/output_file.h"

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
    bool estimatesErrors = true;
};

std::string summaryOf(const RenderOptions& options, const FinishedRun& run) {
    const StageSeconds& seconds = run.report.seconds;
    return fmt::format(
        "{} frames in {}{}\n{} particles, {} steps, {:.1f} s (simulating {:.1f}, drawing {:.1f}, encoding {:.1f}), "
        "state {}\n",
        run.report.frames, options.folder.path, options.video.empty() ? "" : ", video " + options.video,
        engine::largestCount(run.simulation), run.simulation.steps.count, seconds.all, seconds.simulating,
        seconds.drawing, seconds.encoding, run.report.stateHash);
}

void render(RenderOptions options) {
    const scenes::Scene scene = load(options.scene, overridesOf(options.draw));
    const std::string name = runName(options.scene);
    if (options.folder.path.empty()) options.folder.path = (fs::path("out") / name).string();
    const RenderJob job{drawJob(scene, options.draw, options.run, name),
                        frameList(options.frames, scenes::frameCount(scene)), options.folder, options.video,
                        options.estimatesErrors};

    warnOfStart(scene, job.threads);
    if (!options.video.empty()) createFolderOf(options.video);
    const FinishedRun run = renderFrames(job);
    requireComplete(run.report, options.folder.path);
    printResult(options.run, {{"event", "done"}, {"folder", options.folder.path}, {"run", run.json}},
                summaryOf(options, run));
}

}  // namespace

void addRenderCommand(CLI::App& program) {
    CLI::App& command = *program.add_subcommand("render", "simulate and draw a scene: PNG frames, run.json, a video");
    const auto options = std::make_shared<RenderOptions>();
    addTo(command, options->scene);
    addTo(command, options->folder, "out/NAME");
    command.add_option("--video", options->video, "also write an MP4")->type_name("FILE.mp4");
    command.add_option("--frames", options->frames, std::string("draw only ") + kFrameListHelp)->type_name("FRAMES");
    addTo(command, options->draw);
    addErrorFlag(command, options->estimatesErrors);
    addTo(command, options->run);
    command.footer(std::string(kErrorSampleNotes) +
                   "Example: globular render liquid -o out/liquid --video out/liquid.mp4");
    command.callback([options] { render(*options); });
}

}  // namespace tools
