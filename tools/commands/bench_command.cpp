// globular bench: measures how fast the parts of the engine and whole frames run on this machine, and prints the hash
// of what was computed beside each time.
#include <fmt/format.h>

#include <functional>
#include <memory>

#include "engine/core/instruction_sets.h"
#include "engine/forces/simd_forces.h"
#include "scenes/build/library.h"
#include "scenes/build/read_scene.h"
#include "scenes/text/input_error.h"
#include "studies/bench/bench.h"
#include "tools/commands/commands.h"
#include "tools/run/open_renderer.h"
#include "tools/system/json.h"
#include "tools/system/process.h"
#include "tools/system/threads.h"

namespace tools {
namespace {

struct BenchOptions {
    RunOptions run;
    DrawOptions draw;            ///< drawing options, of which only those of the renderer are used
    std::string instructionSet;  ///< name of the SIMD instruction set; empty: the widest that the machine has
    studies::BenchSettings settings;
};

std::string_view nameOf(engine::Precision precision) {
    return precision == engine::Precision::doubles ? "double" : "float";
}

/// @param renderer  what drew; without a name if nothing was drawn
Json jsonOf(const studies::BenchRow& row, const RendererRecord& renderer, int threads) {
    Json json = {{"name", row.name},
                 {"material", row.material},
                 {"particles", row.particles},
                 {"neighbors", row.neighbors},
                 {"threads", threads},
                 {"isa", engine::simdInstructionSet()},
                 {"precision", nameOf(row.precision)},
                 {"seconds", row.seconds},
                 {"steps", row.steps}};
    if (row.particles > 0) {
        json["particle_steps_per_s"] = row.particleStepsPerSecond();
        json["pairs_per_s"] = row.pairsPerSecond();
        json["ns_per_pair"] = row.nanosecondsPerPair();
        json["bytes_per_particle"] = row.bytesPerParticle;
    } else {
        json["rate_per_s"] = row.rate;
    }
    if (!renderer.name.empty()) addTo(json, renderer);
    json["state_hash"] = row.stateHash;
    return json;
}

void print(const studies::BenchRow& row, const RendererRecord& renderer) {
    if (row.particles == 0) {
        fmt::print("{:23} {:13} {:.4g} G{}/s\n", row.name, "", 1e-9 * row.rate, row.name == "copy" ? "B" : "FLOP");
        return;
    }
    const std::string name = renderer.name.empty() ? row.name : row.name + ", " + renderer.name;
    fmt::print("{:23} {:13} {:>9} {:10.1f} {:9} {:12.3f} {:10.2f} {:8.1f} {:8.2f} {:8.0f}  {}\n", name, row.material,
               row.particles, row.neighbors, nameOf(row.precision), 1e3 * row.seconds,
               1e-6 * row.particleStepsPerSecond(), 1e-6 * row.pairsPerSecond(), row.nanosecondsPerPair(),
               row.bytesPerParticle, row.stateHash);
}

/// The scenes of measured/ whose frames are measured: one for each kind of material, and honey, which needs the
/// implicit steppers.
constexpr const char* kFrameScenes[] = {"liquid", "solid", "powder", "honey"};

using RowListener = std::function<void(const studies::BenchRow&, const RendererRecord&)>;

void benchFrames(const BenchOptions& options, const RendererChoice& choice, int threads, const RowListener& listener) {
    const studies::BenchSettings& settings = options.settings;
    for (const char* name : kFrameScenes) {
        const bool draws = settings.wants(studies::kDrawFrame, name);
        if (!draws && !settings.wants(studies::kSimulateFrame, name)) continue;
        const std::string path = scenes::resolveScene(fmt::format("measured/{}", name), sceneFolder());
        const scenes::Scene scene = scenes::loadScene(path, {});
        const OpenedRenderer opened =
            draws ? openRenderer(choice, scene.size, render::Quality::normal, threads) : OpenedRenderer{};
        for (const studies::BenchRow& row : studies::benchFrames(name, scene, opened.renderer.get(), settings.rounds))
            if (settings.wants(row.name, name))
                listener(row, row.name == studies::kDrawFrame ? opened.record : RendererRecord{});
    }
}

void bench(const BenchOptions& options) {
    const int threads = threadCount(options.run);
    const RendererChoice choice = rendererOf(options.draw);
    const bool isText = !options.run.json;
    if (!options.instructionSet.empty()) engine::useInstructionSet(options.instructionSet);
    bool hasRows = false;
    const auto printHead = [&] {
        fmt::print("{} threads, {}; medians of {} rounds\n", threads, engine::simdInstructionSet(),
                   options.settings.rounds);
        fmt::print("{:23} {:13} {:>9} {:>10} {:9} {:>12} {:>10} {:>8} {:>8} {:>8}  {}\n", "name", "material",
                   "particles", "neighbors", "precision", "ms", "M steps/s", "M pairs", "ns/pair", "bytes", "hash");
    };
    const auto report = [&](const studies::BenchRow& row, const RendererRecord& renderer) {
        if (isText && !hasRows) printHead();
        hasRows = true;
        if (isText)
            print(row, renderer);
        else
            printJson(jsonOf(row, renderer, threads));
        flushStandardOutput();
    };
    onThreads(threads, [&] {
        runBench(options.settings, [&](const studies::BenchRow& row) { report(row, {}); });
        benchFrames(options, choice, threads, report);
    });
    if (!hasRows)
        throw scenes::InputError(
            "--filter", fmt::format("no row contains \"{}\"; the rows are: {}; {}, {} of {}", options.settings.filter,
                                    studies::benchRowsText(), studies::kSimulateFrame, studies::kDrawFrame,
                                    fmt::join(kFrameScenes, ", ")));
}

}  // namespace

void addBenchCommand(CLI::App& program) {
    CLI::App& command = *program.add_subcommand(
        "bench", "how fast forces, lists, steps and whole frames run, with hashes of the results");
    const auto options = std::make_shared<BenchOptions>();
    command.add_option("--filter", options->settings.filter, "only rows whose name and material contain this text")
        ->type_name("TEXT");
    command.add_option("--particles", options->settings.counts, "numbers of particles (default: 1000 to 1000000)")
        ->type_name("N");
    command.add_option("--rounds", options->settings.rounds, "how often each is timed (default: 5)")
        ->check(numberAboveZero());
    command.add_option("--isa", options->instructionSet, "the vectors to run on (default: the widest of the machine)")
        ->check(CLI::IsMember(engine::instructionSets()));
    addRendererFlags(command, options->draw);
    addTo(command, options->run);
    command.footer("Example: globular bench --filter \"forces solid\" --particles 1000 32000 --threads 1");
    command.callback([options] { bench(*options); });
}

}  // namespace tools
