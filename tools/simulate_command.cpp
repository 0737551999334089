// globular simulate: particle states only, one PLY file a frame.
#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "engine/diagnostics.h"
#include "scenes/frame_steps.h"
#include "scenes/particle_file.h"
#include "tools/commands.h"
#include "tools/output_file.h"
#include "tools/progress.h"
#include "tools/run_report.h"
#include "tools/scene_options.h"
#include "tools/stopwatch.h"
#include "tools/threads.h"

namespace tools {
namespace {

namespace fs = std::filesystem;

struct SimulateOptions {
    RunOptions run;
    SceneOptions scene;
    std::string folder;
    std::string frames;
    std::string format = "ply";
};

FinishedRun simulateFrames(const scenes::Scene& scene, const FrameRange& frames, const fs::path& folder,
                           Progress& progress) {
    FinishedRun run{engine::start(scene.setup), {}};
    for (int frame = frames.first; frame <= frames.last; ++frame) {
        const double time = scenes::frameTime(scene, frame);
        try {
            const Stopwatch watch(run.report.seconds.simulating);
            scenes::advanceToFrame(scene, run.simulation, frame);
        } catch (const engine::InstabilityError& error) {
            run.report.unstable = error.what();
            break;
        }
        {
            const Stopwatch watch(run.report.seconds.encoding);
            writeFile(folder / fmt::format("particles-{:05}.ply", frame),
                      scenes::encodeParticles(run.simulation.particles));
        }
        ++run.report.frames;
        progress.frameDone(frame, time);
    }
    run.report.stateHash = engine::stateHash(run.simulation.particles);
    return run;
}

void simulate(const SimulateOptions& options) {
    const scenes::Scene scene = load(options.scene);
    const FrameRange frames = frameRange(options.frames, scenes::frameCount(scene));
    const std::string name = fs::path(scene.sourceName).stem().string();
    const fs::path folder = options.folder.empty() ? fs::path("out") / name : fs::path(options.folder);
    const int threads = threadCount(options.run);

    createFolder(folder);
    Progress progress(name, frames.last - frames.first + 1, options.run.talk());
    FinishedRun run;
    double seconds = 0.0;
    {
        const Stopwatch watch(seconds);
        onThreads(threads, [&] { run = simulateFrames(scene, frames, folder, progress); });
    }
    run.report.seconds.all = seconds;
    run.report.threads = threads;
    const auto json = runJson(scene, run.simulation, run.report);
    writeFile(folder / "run.json", json.dump(2) + "\n");
    if (!run.report.unstable.empty()) throw engine::InstabilityError(run.report.unstable);
    if (options.run.json)
        fmt::print("{}\n",
                   nlohmann::ordered_json{{"event", "done"}, {"folder", folder.string()}, {"run", json}}.dump());
    else if (!options.run.quiet)
        fmt::print("{} frames in {}\n{} particles, {} steps, {:.1f} s, state {}\n", run.report.frames, folder.string(),
                   run.simulation.particles.count(), run.simulation.steps.count, run.report.seconds.all,
                   run.report.stateHash);
}

}  // namespace

void addSimulateCommand(CLI::App& program) {
    CLI::App* command = program.add_subcommand("simulate", "particle states only: one PLY file a frame, and run.json");
    const auto options = std::make_shared<SimulateOptions>();
    addTo(*command, options->scene);
    command->add_option("-o,--output", options->folder, "folder for the files (default: out/NAME)")->type_name("DIR");
    command->add_option("--format", options->format, "ply: binary little-endian PLY")->check(CLI::IsMember({"ply"}));
    command->add_option("--frames", options->frames, "write only these frames")->type_name("A-B");
    addTo(*command, options->run);
    command->footer("Example: globular simulate powder -o out/states --frames 0-59");
    command->callback([options] { simulate(*options); });
}

}  // namespace tools
