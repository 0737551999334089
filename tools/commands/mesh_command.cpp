// globular mesh: simulates a scene, or reads the states that an earlier run has left, and writes the surface of its
// metaballs as a closed mesh for each frame.
#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <memory>
#include <vector>

#include "tools/commands/commands.h"
#include "tools/mesh/frame_mesh.h"
#include "tools/run/frame_sequence.h"
#include "tools/run/run_warnings.h"
#include "tools/run/state_sequence.h"
#include "tools/system/command_files.h"
#include "tools/system/process.h"
#include "tools/system/threads.h"

namespace tools {
namespace {

struct MeshOptions {
    RunOptions run;
    SceneOptions scene;
    FolderOptions folder;
    std::string frames;
    std::string states;  ///< folder of states to mesh; empty: the scene is simulated
    MeshSettings mesh;
};

/// The work on one frame of a run: its mesh, which is stored where it is not there yet.
void meshFrame(const SequencedFrame& frame, const FrameMesher& mesher, FrameSource& source, Progress& progress) {
    RunReport& report = source.report();
    FrameMesh mesh;
    if (frame.isWanted && !frame.isKept) {
        const Stopwatch watch(report.seconds.drawing);
        const Progress::Work work(progress, fmt::format("meshing frame {}", frame.number));
        mesh = mesher.meshOf(source.simulation(), frame.number);
        report.mesh["frames"].push_back(mesh.facts);
    }
    const Stopwatch watch(report.seconds.encoding);
    source.store(frame, {reinterpret_cast<const std::uint8_t*>(mesh.bytes.data()), mesh.bytes.size()});
}

/// @param states  whose frames are meshed; nullptr: the scene is simulated
FinishedRun meshFrames(const scenes::Scene& scene, const FrameList& frames, const MeshOptions& options,
                       const SimulatedStates* states) {
    const FrameMesher mesher(scene, options.mesh);
    Progress progress(runName(options.scene), frames.count(), options.run.verbosity());
    Json identity = sceneIdentity(scene);
    identity["mesh"] = mesher.identity();
    FrameFolder folder(options.folder, {mesher.names()}, frames, identity);
    std::unique_ptr<FrameSource> source;
    if (states != nullptr)
        source = std::make_unique<StateSequence>(scene, frames, *states, &folder, progress);
    else
        source = std::make_unique<FrameSequence>(scene, frames, SequenceOptions{&folder, false}, progress);
    RunReport& report = source->report();
    report.threads = threadCount(options.run);
    report.mesh = mesher.description();
    {
        const Stopwatch total(report.seconds.all);
        while (const auto frame = source->next()) {
            meshFrame(*frame, mesher, *source, progress);
            if (!frame->isWanted) continue;
            ++report.frames;
            progress.frameDone(frame->number, frame->time);
        }
        source->finish();
    }
    return source->take();
}

/// What the meshes of a run have in all, such as "8000 vertices and 16000 triangles in the last mesh".
std::string meshLine(const Json& mesh) {
    const Json& frames = mesh["frames"];
    if (frames.empty()) return "no mesh had to be made";
    const Json& last = frames.back();
    return fmt::format("{} vertices, {} triangles and {:.4g} m^3 in the last mesh", last["vertices"].get<std::size_t>(),
                       last["triangles"].get<std::size_t>(), last["volume"].get<double>());
}

std::string summaryOf(const MeshOptions& options, const scenes::Scene& scene, const FinishedRun& run) {
    const RunReport& report = run.report;
    const std::string meshes =
        fmt::format("{} frames in {}\n{}\n", report.frames, options.folder.path, meshLine(report.mesh));
    if (!options.states.empty())
        return meshes + fmt::format("from states in {}: up to {} particles, {:.1f} s, state {}\n", options.states,
                                    report.largestCount, report.seconds.all, report.stateHash);
    return meshes + fmt::format("{} particles, {} steps, {:.1f} s, state {}\n{}", run.simulation.particles.count(),
                                run.simulation.steps.count, report.seconds.all, report.stateHash,
                                troubleLine(scene, run.simulation));
}

void mesh(MeshOptions options) {
    const scenes::Scene scene = load(options.scene);
    const FrameList frames = frameList(options.frames, scenes::frameCount(scene));
    const std::string name = runName(options.scene);
    std::string& folder = options.folder.path;
    if (folder.empty()) folder = defaultOutput(name, "-mesh");

    const std::optional<SimulatedStates> states = openStates(options.states, scene, frames);
    CommandFiles files{scene.files, {}, {{"-o", folder, isRunFile}}};
    if (states) std::ranges::copy(states->files(), std::back_inserter(files.inputs));
    requireSeparate(files);
    const FrameMesher canMesh(scene, options.mesh);
    if (!states)
        warnOfStart(options.scene, scene, threadCount(options.run));
    else if (options.scene.isStrict)
        refuse(scene.warnings);
    if (options.run.verbosity() == Verbosity::normal) printToStderr(metaballsNote(scene, "the mesh"));
    FinishedRun run;
    onThreads(threadCount(options.run), [&] { run = meshFrames(scene, frames, options, states ? &*states : nullptr); });
    const RunReport& report = run.report;
    requireComplete(report, folder);
    printResult(options.run, {{"event", "done"}, {"folder", folder}, {"run", run.json}},
                summaryOf(options, scene, run));
}

}  // namespace

void addMeshCommand(CLI::App& program) {
    CLI::App& command =
        *program.add_subcommand("mesh", "the surface of metaballs: one closed mesh a frame, and run.json");
    const auto options = std::make_shared<MeshOptions>();
    addTo(command, options->scene);
    addStrictFlag(command, options->scene);
    addTo(command, options->folder, "folder for frames and run.json (default: out/NAME-mesh)");
    command.add_option("--frames", options->frames, std::string("write only ") + kFrameListHelp)->type_name("FRAMES");
    command
        .add_option("--states", options->states,
                    "make meshes of the states that `globular simulate` has written of this scene, without simulating")
        ->type_name("DIR");
    command
        .add_option("--cell", options->mesh.cell,
                    "length of the triangles' sides, in radii of the smallest particles (default: 0.5)")
        ->check(numberFrom(0.05, 1.0))
        ->type_name("RADII");
    command
        .add_option(
            "--format", options->mesh.format,
            "ply: normals, colors and velocities; obj: without velocities; vdb: signed distances (default: ply)")
        ->check(CLI::IsMember(kMeshFormats));
    addTo(command, options->run);
    command.footer(
        "The mesh is of the metaballs of look.metaball_reach and look.skin, whatever look.style is.\n"
        "docs/meshes.md says how other programs read it.\n"
        "Example: globular mesh liquid -o out/mesh --frames 0-119 --set look.skin=smooth\n"
        "         globular mesh liquid --states out/liquid-states -o out/fine --cell 0.25");
    command.callback([options] { mesh(*options); });
}

}  // namespace tools
