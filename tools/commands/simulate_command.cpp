// globular simulate: simulates a scene without drawing it, and writes the particles of each frame, or their metaballs'
// field, to a file for each format that is asked for.
#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <memory>

#include "engine/heat/heat_exchange.h"
#include "render/mesh/isosurface.h"
#include "scenes/particles/formats.h"
#include "scenes/particles/vtp.h"
#include "tools/commands/commands.h"
#include "tools/mesh/frame_field.h"
#include "tools/mesh/scene_metaballs.h"
#include "tools/run/frame_sequence.h"
#include "tools/run/run_warnings.h"
#include "tools/system/command_files.h"
#include "tools/system/memory.h"
#include "tools/system/process.h"
#include "tools/system/threads.h"

namespace tools {
namespace {

struct SimulateOptions {
    RunOptions run;
    SceneOptions scene;
    FolderOptions folder;
    std::string frames;
    bool estimatesErrors = true;
    std::vector<std::string> formats = {"ply"};
    SimulationHost* host = nullptr;
};

scenes::ParticleFrame particleFrame(const scenes::Scene& scene, const engine::Simulation& simulation,
                                    const SequencedFrame& frame) {
    scenes::ParticleFrame result{
        simulation.particles, {frame.number, frame.time, scene.simulationHash}, {}, scene.materialColors};
    for (const engine::Material& material : scene.setup.materials) result.materialNames.push_back(material.name);
    for (std::size_t p = 0; p < simulation.particles.enthalpy.size(); ++p)
        result.temperature.push_back(engine::temperatureOf(scene.setup.materials, simulation.particles, p));
    return result;
}

/// Files in one format, one a frame.
struct StateFiles {
    FrameNames names;
    std::function<std::string(const engine::Simulation&, const SequencedFrame&)> encode;
};

bool isWanted(const SimulateOptions& options, std::string_view format) {
    return std::ranges::find(options.formats, format) != options.formats.end();
}

/// The files that are asked for, each once. @param scene  must outlive what is returned
std::vector<StateFiles> filesOf(const scenes::Scene& scene, const SimulateOptions& options) {
    std::vector<StateFiles> files;
    for (const scenes::ParticleFormat& format : scenes::particleFormats()) {
        if (!isWanted(options, format.name)) continue;
        const auto encode = [&scene, write = format.encode](const auto& simulation, const auto& frame) {
            return withMemoryForParticles(simulation.particles.count(),
                                          [&] { return write(particleFrame(scene, simulation, frame)); });
        };
        files.push_back({stateNames(format), encode});
    }
    if (isWanted(options, kFieldNames.format))
        files.push_back({kFieldNames, [&scene](const auto& simulation, const auto& frame) {
                             return encodeFrameField(scene, simulation, frame.number);
                         }});
    return files;
}

/// The index of the frames in VTK's format, with their times.
FrameIndex vtpSeries(const scenes::Scene& scene, const FrameNames& names) {
    return {names, kVtpSeriesName, [&scene, names](const std::vector<int>& frames) {
                std::vector<scenes::TimedFile> files;
                for (const int frame : frames)
                    files.push_back({names.fileName(frame), scenes::frameTime(scene, frame)});
                return scenes::encodeVtpSeries(files);
            }};
}

/// Writes the frames of a scene, which must outlive the writer, into a folder, in some formats.
class StateWriter {
 public:
    StateWriter(const scenes::Scene& scene, const FrameList& frames, const SimulateOptions& options)
        : files_(filesOf(scene, options)), folder_(options.folder, names(), frames, sceneIdentity(scene)) {
        for (const StateFiles& files : files_)
            if (files.names.format == "vtp") folder_.keepIndex(vtpSeries(scene, files.names));
    }

    FrameFolder& folder() { return folder_; }

    /// Writes those files of a frame that are not kept.
    void write(const SequencedFrame& frame, const engine::Simulation& simulation) {
        if (!frame.isWanted || frame.isKept) return;
        for (const StateFiles& files : files_) {
            if (folder_.isKept(frame.number, files.names)) continue;
            const std::string bytes = files.encode(simulation, frame);
            folder_.write(frame.number, files.names,
                          {reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()}, frame.stateHash);
        }
    }

 private:
    std::vector<FrameNames> names() const {
        std::vector<FrameNames> all;
        for (const StateFiles& files : files_) all.push_back(files.names);
        return all;
    }

    std::vector<StateFiles> files_;
    FrameFolder folder_;
};

FinishedRun simulateFrames(const scenes::Scene& scene, const FrameList& frames, const SimulateOptions& options,
                           const std::string& title) {
    Progress progress(title, frames.count(), options.run.verbosity());
    StateWriter states(scene, frames, options);
    FrameSequence sequence(scene, frames, {&states.folder(), options.estimatesErrors, options.host}, progress);
    RunReport& report = sequence.report();
    report.threads = threadCount(options.run);
    {
        const Stopwatch total(report.seconds.all);
        while (const auto frame = sequence.next()) {
            const Stopwatch watch(report.seconds.encoding);
            states.write(*frame, sequence.simulation());
            sequence.storeCheckpoint(*frame);
            if (!frame->isWanted) continue;
            ++report.frames;
            progress.frameDone(frame->number, frame->time);
        }
        sequence.finish();
    }
    return sequence.take();
}

/// A format as --format names it.
struct NamedFormat {
    std::string_view name;
    std::string_view help;
};

/// What can be written: particles, and the metaballs' field.
std::vector<NamedFormat> allFormats() {
    std::vector<NamedFormat> formats;
    for (const scenes::ParticleFormat& format : scenes::particleFormats())
        formats.push_back({format.name, format.help});
    formats.push_back({kFieldNames.format, "the metaballs' field as an OpenVDB fog volume (Blender, Houdini)"});
    return formats;
}

void simulate(SimulateOptions options) {
    const scenes::Scene scene = load(options.scene);
    const FrameList frames = frameList(options.frames, scenes::frameCount(scene));
    const std::string name = runName(options.scene);
    std::string& folder = options.folder.path;
    if (folder.empty()) folder = defaultOutput(name, "-states");

    if (isWanted(options, kFieldNames.format)) render::requireOpenVdb();
    requireSeparate({scene.files, {}, {{"-o", folder, isRunFile}}});
    warnOfStart(options.scene, scene, threadCount(options.run));
    if (options.host != nullptr) options.host->load(options.scene, scene);
    if (isWanted(options, kFieldNames.format) && options.run.verbosity() == Verbosity::normal)
        printToStderr(metaballsNote(scene, "the field"));
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

void addSimulateCommand(CLI::App& program, SimulationHost* host) {
    CLI::App& command = *program.add_subcommand(
        "simulate", "particle states only: a file a frame, for other programs and scenes, and run.json");
    const auto options = std::make_shared<SimulateOptions>();
    options->host = host;
    if (host != nullptr) options->run.threads = 1;  // a host has several processes, often one for each processor
    addTo(command, options->scene);
    addStrictFlag(command, options->scene);
    addTo(command, options->folder, "folder for frames and run.json (default: out/NAME-states)");
    addFormats(command, allFormats(), options->formats);
    command.add_option("--frames", options->frames, std::string("write only ") + kFrameListHelp)->type_name("FRAMES");
    addErrorFlag(command, options->estimatesErrors);
    addTo(command, options->run);
    command.footer(std::string(kErrorSampleNotes) +
                   "Example: globular simulate powder -o out/states --frames 0-59 --format ply,vtp");
    command.callback([options] { simulate(*options); });
}

}  // namespace tools
