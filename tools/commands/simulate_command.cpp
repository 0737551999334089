// globular simulate: simulates a scene without drawing it, and writes the particles of each frame as a PLY file.
#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <string_view>

#include "render/output/atomic_file.h"
#include "scenes/model/particle_file.h"
#include "tools/commands/commands.h"
#include "tools/run/frame_sequence.h"
#include "tools/run/run_warnings.h"
#include "tools/run/threads.h"
#include "tools/system/command_files.h"

namespace tools {
namespace {

namespace fs = std::filesystem;

struct SimulateOptions {
    RunOptions run;
    SceneOptions scene;
    FolderOptions folder;
    std::string frames;
    bool estimatesErrors = true;
    std::string format = "ply";
};

FinishedRun simulateFrames(const scenes::Scene& scene, const FrameList& frames, const SimulateOptions& options,
                           const std::string& title) {
    Progress progress(title, frames.count(), options.run.verbosity());
    FrameFolder folder(options.folder, kStateNames, frames, sceneIdentity(scene));
    FrameSequence sequence(scene, frames, {&folder, options.estimatesErrors}, progress);
    RunReport& report = sequence.report();
    report.threads = threadCount(options.run);
    {
        const Stopwatch total(report.seconds.all);
        while (const auto frame = sequence.next()) {
            std::string ply;
            const Stopwatch watch(report.seconds.encoding);
            if (frame->isWanted && !frame->isKept)
                ply = scenes::encodeParticles(sequence.simulation().particles,
                                              scenes::StateStamp{frame->number, frame->time, scene.simulationHash});
            sequence.store(*frame, {reinterpret_cast<const std::uint8_t*>(ply.data()), ply.size()});
            if (!frame->isWanted) continue;
            ++report.frames;
            progress.frameDone(frame->number, frame->time);
        }
        sequence.finish();
    }
    return sequence.take();
}

void simulate(SimulateOptions options) {
    const scenes::Scene scene = load(options.scene);
    const FrameList frames = frameList(options.frames, scenes::frameCount(scene));
    const std::string name = runName(options.scene);
    constexpr std::string_view kSuffix = "-states";
    std::string& folder = options.folder.path;
    if (folder.empty())
        folder = (fs::path("out") / (render::shortenedName(name, kSuffix.size()) + std::string(kSuffix))).string();

    requireSeparate({scene.files, {}, {{"-o", folder, isRunFile}}});
    warnOfStart(options.scene, scene, threadCount(options.run));
    FinishedRun run;
    onThreads(threadCount(options.run), [&] { run = simulateFrames(scene, frames, options, name); });
    const RunReport& report = run.report;
    requireComplete(report, folder);
    printResult(options.run, {{"event", "done"}, {"folder", folder}, {"run", run.json}},
                fmt::format("{} frames in {}\n{} particles, {} steps, {:.1f} s, state {}\n{}", report.frames, folder,
                            run.simulation.particles.count(), run.simulation.steps.count, report.seconds.all,
                            report.stateHash, troubleLine(scene, run.simulation)));
}

}  // namespace

void addSimulateCommand(CLI::App& program) {
    CLI::App& command = *program.add_subcommand("simulate", "particle states only: one PLY file a frame, and run.json");
    const auto options = std::make_shared<SimulateOptions>();
    addTo(command, options->scene);
    addStrictFlag(command, options->scene);
    addTo(command, options->folder, "folder for frames and run.json (default: out/NAME-states)");
    command.add_option("--format", options->format, "ply: binary little-endian PLY")->check(CLI::IsMember({"ply"}));
    command.add_option("--frames", options->frames, std::string("write only ") + kFrameListHelp)->type_name("FRAMES");
    addErrorFlag(command, options->estimatesErrors);
    addTo(command, options->run);
    command.footer(std::string(kErrorSampleNotes) + "Example: globular simulate powder -o out/states --frames 0-59");
    command.callback([options] { simulate(*options); });
}

}  // namespace tools
