// globular study stability: the hard cases of scenes/hard, each with the paper's stepper and with ours.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "scenes/build/library.h"
#include "studies/stability/stability.h"
#include "studies/stability/stability_text.h"
#include "tools/commands/commands.h"
#include "tools/pages/stability_page.h"
#include "tools/run/scene_options.h"
#include "tools/system/json.h"
#include "tools/system/output_file.h"
#include "tools/system/shell_words.h"
#include "tools/system/standard_streams.h"
#include "tools/system/threads.h"

namespace tools {
namespace {

namespace fs = std::filesystem;

struct StabilityOptions {
    std::vector<std::string> cases;
    std::string folder = "out/study-stability";
    bool quick = false;
    RunOptions run;
};

constexpr std::string_view kHardFolder = "hard/";

/// The built-in hard cases by their number.
std::vector<studies::CaseOptions> allCases() {
    std::vector<std::pair<int, studies::CaseOptions>> cases;
    for (const scenes::LibraryEntry& entry : scenes::listScenes(sceneFolders())) {
        if (entry.name.rfind(kHardFolder, 0) != 0) continue;
        const scenes::Scene scene = scenes::loadScene(entry.path, {});
        cases.push_back({scene.study ? scene.study->number : 0, {entry.name.substr(kHardFolder.size()), entry.path}});
    }
    std::stable_sort(cases.begin(), cases.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    std::vector<studies::CaseOptions> sorted;
    for (auto& [number, options] : cases) sorted.push_back(std::move(options));
    return sorted;
}

/// A case by its name among the hard ones, else like any SCENE.
studies::CaseOptions caseNamed(const std::string& name, const std::vector<studies::CaseOptions>& builtIn) {
    for (const studies::CaseOptions& known : builtIn)
        if (known.name == name) return known;
    return {fs::path(name).stem().string(), scenes::resolveScene(name, sceneFolders())};
}

std::vector<studies::CaseOptions> chosenCases(const StabilityOptions& options) {
    const std::vector<studies::CaseOptions> builtIn = allCases();
    std::vector<studies::CaseOptions> chosen;
    for (const std::string& name : options.cases) chosen.push_back(caseNamed(name, builtIn));
    if (chosen.empty()) chosen = builtIn;
    for (studies::CaseOptions& one : chosen) one.quick = options.quick;
    return chosen;
}

void tellCase(const studies::CaseResult& result, Verbosity verbosity) {
    const studies::VariantResult& worst = studies::worstOfOurs(result);
    if (verbosity == Verbosity::normal)
        printToStderr(fmt::format("{}: {} variants, {:.1f} s\n", result.name, result.variants.size(), result.seconds));
    if (verbosity != Verbosity::json) return;
    const Json line = {{"event", "case"},
                       {"case", result.name},
                       {"observable", scenes::infoOf(worst.study.observable).name},
                       {"value", worst.ours.value},
                       {"limit", worst.study.limit},
                       {"passes", studies::oursPasses(result)},
                       {"paper_as_expected", studies::paperIsAsExpected(result)},
                       {"seconds", result.seconds}};
    printJson(line);
}

std::string commandText(const StabilityOptions& options) {
    std::vector<std::string> words = {"globular", "study", "stability"};
    words.insert(words.end(), options.cases.begin(), options.cases.end());
    return shellLine(words) + (options.quick ? " --quick" : "") +
           fmt::format(" --threads {}", threadCount(options.run));
}

void writeResults(const StabilityOptions& options, const std::vector<studies::CaseResult>& results) {
    const fs::path folder = options.folder;
    writeFile(folder / "stability.csv", studies::stabilityCsv(results));
    writeFile(folder / "index.html", stabilityPage(results, commandText(options)));
    if (options.run.verbosity() != Verbosity::normal) return;
    double seconds = 0.0;
    for (const studies::CaseResult& result : results) seconds += result.seconds;
    fmt::print("{}\n{} cases in {:.0f} s; all of it: {}\n", studies::stabilityTable(results), results.size(), seconds,
               (folder / "index.html").string());
}

void study(const StabilityOptions& options) {
    createFolder(options.folder);
    std::vector<studies::CaseResult> results;
    for (const studies::CaseOptions& one : chosenCases(options)) {
        onThreads(threadCount(options.run), [&] { results.push_back(studies::runCase(one)); });
        tellCase(results.back(), options.run.verbosity());
    }
    writeResults(options, results);
    const std::string problems = studies::stabilityProblems(results);
    if (!problems.empty()) throw std::runtime_error(problems);
}

std::string notes() {
    std::string text = "Observables:\n";
    for (const scenes::ObservableInfo& info : scenes::observables())
        text += fmt::format("  {:<18} {}\n", info.name, info.help);
    return text;
}

}  // namespace

void addStudyStability(const Command& study) {
    const Command command = study.command(
        "stability", "the hard cases, with the paper's stepper and with ours; fails unless all come out as they must");
    const auto options = std::make_shared<StabilityOptions>();
    command.option("CASE", options->cases, "which hard cases (default: all)");
    command.option("-o,--output", options->folder, "folder to write to (default: out/study-stability)").of("DIR");
    command.flag("--quick", options->quick, "fewer variants and particles");
    addTo(command, options->run);
    command.example("globular study stability honey rigid -o out/stability", notes());
    command.run([options] { tools::study(*options); });
}

}  // namespace tools
