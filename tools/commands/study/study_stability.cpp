// globular study stability: runs the hard cases of scenes/library/hard with the paper's stepper and with the scene's
// own, and fails unless all come out as they must.
#include <fmt/format.h>

#include <filesystem>
#include <map>
#include <memory>
#include <stdexcept>

#include "scenes/build/library.h"
#include "scenes/build/read_scene.h"
#include "studies/stability/stability.h"
#include "tools/commands/study/study_command.h"
#include "tools/pages/study_pages.h"
#include "tools/system/output_file.h"
#include "tools/system/text.h"
#include "tools/system/threads.h"

namespace tools {
namespace {

namespace fs = std::filesystem;

struct StabilityOptions : StudyOptions {
    std::vector<std::string> cases;
};

constexpr std::string_view kHardFolder = "hard/";

/// The built-in hard cases, ordered by their number.
std::vector<studies::CaseOptions> allCases() {
    std::multimap<int, studies::CaseOptions> byNumber;
    for (const scenes::LibraryEntry& entry : scenes::listScenes(sceneFolder())) {
        if (!entry.name.starts_with(kHardFolder)) continue;
        const scenes::Scene scene = scenes::loadScene(entry.path, {});
        byNumber.insert({scene.study ? scene.study->number : 0, {entry.name.substr(kHardFolder.size()), entry.path}});
    }
    std::vector<studies::CaseOptions> cases;
    for (const auto& [number, options] : byNumber) cases.push_back(options);
    return cases;
}

/// The built-in hard case of that name, or else the scene file or built-in scene that the name stands for.
studies::CaseOptions caseNamed(const std::string& name, const std::vector<studies::CaseOptions>& builtIn) {
    for (const studies::CaseOptions& known : builtIn)
        if (known.name == name) return known;
    return {fs::path(name).stem().string(), scenes::resolveScene(name, sceneFolder())};
}

std::vector<studies::CaseOptions> chosenCases(const StabilityOptions& options) {
    const std::vector<studies::CaseOptions> builtIn = allCases();
    std::vector<studies::CaseOptions> chosen;
    for (const std::string& name : options.cases) chosen.push_back(caseNamed(name, builtIn));
    if (chosen.empty()) chosen = builtIn;
    for (studies::CaseOptions& one : chosen) one.quick = options.quick;
    return chosen;
}

void reportCase(const StabilityOptions& options, const studies::CaseResult& result) {
    const studies::VariantResult& worst = studies::worstVariant(result, &studies::VariantResult::ours);
    reportProgress(options,
                   {{"event", "case"},
                    {"case", result.name},
                    {"observable", scenes::infoOf(worst.study.observable).name},
                    {"value", worst.ours.value},
                    {"limit", worst.study.limit},
                    {"passes", studies::oursPasses(result)},
                    {"paper_as_expected", studies::paperIsAsExpected(result)},
                    {"seconds", result.seconds}},
                   fmt::format("{}: {} variants, {:.1f} s\n", result.name, result.variants.size(), result.seconds));
}

void study(const StabilityOptions& options) {
    const std::vector<studies::CaseOptions> cases = chosenCases(options);
    std::vector<fs::path> inputs;
    for (const studies::CaseOptions& one : cases) inputs.emplace_back(one.path);
    prepareFolder(options, inputs);
    std::vector<studies::CaseResult> results;
    double seconds = 0.0;
    for (const studies::CaseOptions& one : cases) {
        onThreads(threadCount(options.run), [&] { results.push_back(studies::runCase(one)); });
        seconds += results.back().seconds;
        reportCase(options, results.back());
    }
    writeFile(fs::path(options.folder) / "stability.csv", studies::stabilityCsv(results));
    std::vector<std::string> words;
    for (const std::string& name : options.cases) words.push_back(operandOf(name));
    finishStudy(options, stabilityPage(results, commandLineOf(options, words)),
                fmt::format("{}\n{} cases in {:.0f} s; ", textTable(stabilityTable(results)), results.size(), seconds));
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

void addStudyStability(CLI::App& study) {
    CLI::App& command = *study.add_subcommand(
        "stability", "the hard cases, with the paper's stepper and with ours; fails unless all come out as they must");
    const auto options = std::make_shared<StabilityOptions>();
    command.add_option("CASE", options->cases, "which hard cases (default: all)");
    addStudyFlags(command, *options, "fewer variants and particles");
    command.footer(notes() + "\nExample: globular study stability honey rigid -o out/stability");
    command.callback([options] { tools::study(*options); });
}

}  // namespace tools
