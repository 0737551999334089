// globular study scaling: time per step against the number of particles, beside the paper's Table 2 and beside a peer.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <iterator>
#include <memory>
#include <nlohmann/json.hpp>
#include <string_view>

#include "render/output/child_process.h"
#include "render/picture/system_error.h"
#include "studies/common/timing.h"
#include "tools/commands/commands.h"
#include "tools/pages/scaling_page.h"
#include "tools/run/scene_options.h"
#include "tools/system/gnuplot.h"
#include "tools/system/json.h"
#include "tools/system/output_file.h"
#include "tools/system/standard_streams.h"
#include "tools/system/threads.h"

namespace tools {
namespace {

namespace fs = std::filesystem;

struct ScalingOptions {
    RunOptions run;
    std::string folder = "out/study-scaling";
    std::string peer;
    bool quick = false;
};

/// Fountain, liquid, solid and powder of the paper's figures, and cubes of the same materials.
constexpr std::array kScenes = {"paper/figure-1", "paper/figure-2", "paper/figure-3", "paper/figure-4"};
constexpr std::array kMaterials = {"solid", "liquid", "powder"};

studies::ScalingSettings settingsFor(const ScalingOptions& options) {
    studies::ScalingSettings settings;
    if (options.quick) {
        settings.cubeSizes = {1000, 10000, studies::kPeerParticles};
        settings.mostInScenes = 100;
        settings.mostByEveryPair = 1000;
        settings.rounds = 1;
        settings.secondsPerRound = 0.02;
    }
    return settings;
}

studies::ScalingListener rowReporter(Verbosity verbosity) {
    return [verbosity](const studies::ScalingRow& row) {
        if (verbosity == Verbosity::json)
            printJson(Json{{"event", "row"},
                           {"subject", row.subject},
                           {"particles", row.particles},
                           {"seconds", row.list},
                           {"state_hash", row.stateHash}});
        else if (verbosity == Verbosity::normal)
            printToStderr(
                fmt::format("{}: {} particles, {:.4g} ms a step\n", row.subject, row.particles, 1e3 * row.list));
    };
}

ScalingResults measure(const ScalingOptions& options) {
    const studies::ScalingSettings settings = settingsFor(options);
    ScalingResults results;
    const auto take = [&](std::vector<studies::ScalingRow> rows) {
        const std::vector<studies::ScalingFit> fits = studies::fitsOf(rows);
        results.fits.insert(results.fits.end(), fits.begin(), fits.end());
        std::move(rows.begin(), rows.end(), std::back_inserter(results.rows));
    };
    for (const char* name : kScenes) {
        const scenes::Scene scene = load({name, {}, {}});
        take(studies::measureScene(name, scene, settings, rowReporter(options.run.verbosity())));
    }
    for (const char* material : kMaterials)
        take(studies::measureBlocks(material, settings, rowReporter(options.run.verbosity())));
    return results;
}

struct LammpsRun {
    std::string output;
    std::string ending;  ///< as ChildProcess::wait() says it
};

/// Throws render::SystemError where there is no mpirun.
LammpsRun runLammps(const std::string& script, int ranks) {
    std::vector<std::string> arguments = {"mpirun", "--bind-to", "none", "-np", fmt::format("{}", ranks)};
    if (geteuid() == 0) arguments.emplace_back("--allow-run-as-root");
    for (const char* argument : {"lmp", "-log", "none"}) arguments.emplace_back(argument);
    render::ChildProcess lammps(arguments, render::kNoTimeout);
    lammps.write({reinterpret_cast<const std::uint8_t*>(script.data()), script.size()});
    const std::string ending = lammps.wait();
    constexpr std::size_t kMostBytes = 1U << 20;
    return {lammps.output(kMostBytes), ending};
}

/// Seconds of the timed loop of a script. Throws render::SystemError with what kept the program from it, and what to do
/// about it where that is no error of LAMMPS' own.
double lammpsSeconds(const std::string& script, int ranks) {
    constexpr std::string_view kRemedy = "(install LAMMPS: Debian's package lammps)";
    LammpsRun run;
    try {
        run = runLammps(script, ranks);
    } catch (const render::SystemError& error) {
        throw render::SystemError(fmt::format("{} {}", error.what(), kRemedy));
    }
    const std::optional<double> seconds = studies::lammpsSeconds(run.output);
    if (run.ending.empty() && seconds) return *seconds;
    const std::string error = studies::lammpsError(run.output);
    if (!error.empty()) throw render::SystemError(error);
    throw render::SystemError(
        fmt::format("mpirun lmp ended with {} {}", run.ending.empty() ? "no time" : run.ending, kRemedy));
}

/// Our times of a step at the peer's number of particles.
studies::ScalingRow rowBeside(const ScalingOptions& options) {
    studies::ScalingSettings settings = settingsFor(options);
    settings.cubeSizes = {studies::kPeerParticles};
    settings.mostByEveryPair = 0;
    settings.rounds = 1;
    return studies::measureCubes(kMaterials[0], settings, [](const studies::ScalingRow&) {}).front();
}

void measurePeer(ScalingResults& results, const ScalingOptions& options) {
    constexpr int kRounds = 5;
    const int ranks = threadCount(options.run);
    results.peerText = fmt::format("LAMMPS with {} MPI ranks and, in turn, ours with {} threads: {}, {} particles.",
                                   ranks, ranks, kMaterials[0], studies::kPeerParticles);
    for (const studies::PeerForce force : {studies::PeerForce::lennardJones, studies::PeerForce::dissipative}) {
        std::vector<double> rounds, ours, oursInFloat;
        try {
            for (int round = 0; round < kRounds; ++round) {
                rounds.push_back(lammpsSeconds(studies::lammpsScript(force), ranks));
                studies::ScalingRow beside;
                onThreads(ranks, [&] { beside = rowBeside(options); });
                ours.push_back(beside.list);
                oursInFloat.push_back(beside.listInFloat);
            }
        } catch (const render::SystemError& error) {
            results.peerText += fmt::format(" {}: {}.", studies::nameOf(force), error.what());
            continue;
        }
        studies::PeerRow row;
        row.name = "LAMMPS " + studies::nameOf(force);
        row.secondsPerStep = studies::median(rounds) / studies::kPeerSteps;
        row.ratio = row.secondsPerStep / studies::median(ours);
        row.ratioInFloat = row.secondsPerStep / studies::median(oursInFloat);
        results.peers.push_back(row);
    }
}

std::string commandOf(const ScalingOptions& options) {
    return fmt::format("globular study scaling{}{} --threads {}", options.quick ? " --quick" : "",
                       options.peer.empty() ? "" : " --peer " + options.peer, threadCount(options.run));
}

void print(const ScalingResults& results) {
    fmt::print("{:16} {:>9} {:>10} {:>13} {:>14} {:>10} {:>17}\n", "scene, material", "particles", "neighbors",
               "published, ms", "every pair, ms", "list, ms", "list in float, ms");
    const auto milliseconds = [](const std::optional<double>& seconds) {
        return seconds ? fmt::format("{:.4g}", 1e3 * *seconds) : std::string("-");
    };
    for (const studies::ScalingRow& row : results.rows)
        fmt::print("{:16} {:>9} {:>10.1f} {:>13} {:>14} {:>10} {:>17}\n", row.subject, row.particles, row.neighbors,
                   milliseconds(row.published), milliseconds(row.everyPair), milliseconds(row.list),
                   milliseconds(row.listInFloat));
    for (const studies::ScalingFit& fit : results.fits)
        fmt::print("{}, {}: time grows like N^{:.2f} from {} to {}\n", fit.subject, fit.method, fit.exponent, fit.from,
                   fit.to);
    if (!results.peerText.empty()) fmt::print("{}\n", results.peerText);
    for (const studies::PeerRow& row : results.peers)
        fmt::print("{}: {:.2f} million particle-steps a second; ours {:.2f} times that, {:.2f} in float\n", row.name,
                   1e-6 * row.particleStepsPerSecond(), row.ratio, row.ratioInFloat);
}

void study(const ScalingOptions& options) {
    const fs::path folder = options.folder;
    createFolder(folder);
    ScalingResults results;
    onThreads(threadCount(options.run), [&] { results = measure(options); });
    if (!options.peer.empty()) measurePeer(results, options);
    writeFile(folder / "scaling.csv", studies::scalingCsv(results.rows));
    writeFile(folder / "exponents.csv", studies::fitsCsv(results.fits));
    const std::string plot = drawPlot(studies::scalingPlot(results.rows));
    writeFile(folder / "scaling.svg", plot);
    writeFile(folder / "index.html", scalingPage(results, plot, commandOf(options)));
    if (options.run.verbosity() != Verbosity::normal) return;
    print(results);
    fmt::print("all of it: {}\n", (folder / "index.html").string());
}

}  // namespace

void addStudyScaling(const Command& study) {
    const Command command =
        study.command("scaling", "time per step against the number of particles, beside the paper's Table 2");
    const auto options = std::make_shared<ScalingOptions>();
    command.option("-o,--output", options->folder, "folder to write to (default: out/study-scaling)").of("DIR");
    command.option("--peer", options->peer, "another program to measure in the same run, if it is installed")
        .oneOf({"lammps"});
    command.flag("--quick", options->quick, "fewer sizes, one round");
    addTo(command, options->run);
    command.example("globular study scaling --peer lammps -o out/scaling");
    command.run([options] { tools::study(*options); });
}

}  // namespace tools
