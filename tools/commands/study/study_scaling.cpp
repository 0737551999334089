// globular study scaling: measures the time of a step against the number of particles, beside the paper's Table 2 and
// another program.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <iterator>
#include <memory>
#include <string_view>

#include "render/output/child_process.h"
#include "render/picture/system_error.h"
#include "studies/common/timing.h"
#include "tools/commands/study/study_command.h"
#include "tools/pages/study_pages.h"
#include "tools/system/output_file.h"
#include "tools/system/threads.h"

namespace tools {
namespace {

namespace fs = std::filesystem;

struct ScalingOptions : StudyOptions {
    std::string peer;
};

/// The scenes of the paper's figures (a fountain, a liquid, a solid and a powder), and the materials of cubes of
/// particles.
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

studies::ScalingListener rowReporter(const ScalingOptions& options) {
    return [&options](const studies::ScalingRow& row) {
        reportProgress(options,
                       {{"event", "row"},
                        {"subject", row.subject},
                        {"particles", row.particles},
                        {"seconds", row.list},
                        {"state_hash", row.stateHash}},
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
        take(studies::measureScene(name, scene, settings, rowReporter(options)));
    }
    for (const char* material : kMaterials) take(studies::measureCubes(material, settings, rowReporter(options)));
    return results;
}

struct LammpsRun {
    std::string output;
    std::string ending;  ///< how LAMMPS failed, such as "exit status 1"; empty if it did not
};

/// @throws render::SystemError if mpirun cannot be started
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

/// Seconds that LAMMPS takes for the timed loop of a script.
/// @throws render::SystemError with LAMMPS' own error, or else with what failed and how to install LAMMPS
double lammpsSeconds(const std::string& script, int ranks) {
    constexpr std::string_view kRemedy = "(install LAMMPS: Debian's package lammps)";
    LammpsRun run;
    try {
        run = runLammps(script, ranks);
    } catch (const render::ProgramMissing& error) {
        throw render::SystemError(fmt::format("{} {}", error.what(), kRemedy));
    }
    const std::optional<double> seconds = studies::lammpsSeconds(run.output);
    if (run.ending.empty() && seconds) return *seconds;
    const std::string error = studies::lammpsError(run.output);
    if (!error.empty()) throw render::SystemError(error);
    throw render::SystemError(
        fmt::format("mpirun lmp ended with {} {}", run.ending.empty() ? "no time" : run.ending, kRemedy));
}

/// This program's times of a step with as many particles as the other program simulates.
studies::ScalingRow rowForPeer(const ScalingOptions& options) {
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
                studies::ScalingRow own;
                onThreads(ranks, [&] { own = rowForPeer(options); });
                ours.push_back(own.list);
                oursInFloat.push_back(own.listInFloat);
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

/// The results as text for the terminal.
std::string summaryOf(const ScalingResults& results) {
    std::string text = textTable(parseCsv(studies::scalingCsv(results.rows), 0));
    for (const studies::ScalingFit& fit : results.fits)
        text += fmt::format("{}, {}: time grows like N^{:.2f} from {} to {}\n", fit.subject, fit.method, fit.exponent,
                            fit.from, fit.to);
    if (!results.peerText.empty()) text += results.peerText + "\n";
    for (const studies::PeerRow& row : results.peers)
        text += fmt::format("{}: {:.2f} million particle-steps a second; ours {:.2f} times that, {:.2f} in float\n",
                            row.name, 1e-6 * row.particleStepsPerSecond(), row.ratio, row.ratioInFloat);
    return text;
}

void study(const ScalingOptions& options) {
    const fs::path folder = options.folder;
    prepareFolder(options, {});
    ScalingResults results;
    onThreads(threadCount(options.run), [&] { results = measure(options); });
    std::vector<std::string> words;
    if (!options.peer.empty()) {
        measurePeer(results, options);
        words = {"--peer", options.peer};
    }
    writeFile(folder / "scaling.csv", studies::scalingCsv(results.rows));
    writeFile(folder / "exponents.csv", studies::fitsCsv(results.fits));
    results.plot = writePlot(options, "scaling.svg", studies::scalingPlot(results.rows));
    finishStudy(options, scalingPage(results, commandLineOf(options, words)), summaryOf(results));
}

}  // namespace

void addStudyScaling(CLI::App& study) {
    CLI::App& command =
        *study.add_subcommand("scaling", "time per step against the number of particles, beside the paper's Table 2");
    const auto options = std::make_shared<ScalingOptions>();
    command.add_option("--peer", options->peer, "another program to measure in the same run, if it is installed")
        ->check(CLI::IsMember({"lammps"}));
    addStudyFlags(command, *options, "fewer sizes, one round");
    command.footer("Example: globular study scaling --peer lammps -o out/scaling");
    command.callback([options] { tools::study(*options); });
}

}  // namespace tools
