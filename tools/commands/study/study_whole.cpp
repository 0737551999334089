// globular study accuracy --whole: the automatic stepper against the best fixed stepper and step, over whole scenes.
// Writes tables and a page.
#include <fmt/format.h>

#include <filesystem>
#include <set>

#include "engine/stepping/take_step.h"
#include "scenes/build/read_scene.h"
#include "scenes/text/input_error.h"
#include "studies/accuracy/whole_scene.h"
#include "tools/commands/study/study_accuracy.h"
#include "tools/pages/study_pages.h"
#include "tools/system/output_file.h"
#include "tools/system/threads.h"

namespace tools {
namespace {

namespace fs = std::filesystem;

struct WholeSubject {
    std::string name;  ///< in tables
    scenes::Scene scene;
};

std::vector<WholeSubject> wholeSubjectsOf(const AccuracyOptions& options) {
    std::vector<WholeSubject> subjects;
    std::set<std::string> names;
    for (const std::string& text : options.scenes) {
        subjects.push_back({subjectName(text), load({text, options.overrides, {}})});
        if (!names.insert(subjects.back().name).second)
            throw scenes::InputError(text, "two scenes would share a name in the tables");
    }
    return subjects;
}

studies::WholeScene measureSubject(const WholeSubject& subject, const AccuracyOptions& options) {
    studies::WholeSettings settings;
    if (options.quick) {
        settings.windowCount = 4;
        settings.rounds = 1;
    }
    studies::WholeScene whole;
    try {
        onThreads(threadCount(options.run), [&] {
            whole = studies::measureWhole(subject.name, subject.scene, settings, runReporter(options, subject.name));
        });
    } catch (const engine::InstabilityError& error) {
        throw engine::InstabilityError(subject.name + ": " + error.what());
    }
    return whole;
}

void writeWholeTables(const fs::path& folder, const std::vector<studies::WholeScene>& results) {
    writeFile(folder / "whole.csv", studies::wholeCsv(results));
    writeFile(folder / "whole_steppers.csv", studies::wholeSteppersCsv(results));
    writeFile(folder / "whole_ladder.csv", studies::wholeLadderCsv(results));
    writeFile(folder / "whole_windows.csv", studies::wholeWindowsCsv(results));
}

std::string bestText(const std::optional<studies::FixedWholeRun>& best, double ratio) {
    return best ? fmt::format("{:5.2f} ({} {:.3g} ms)", ratio, engine::nameOf(best->stepper), 1e3 * best->step) : "-";
}

/// A line for the terminal.
std::string wholeLineOf(const studies::WholeScene& whole) {
    const auto evaluations = bestBy(whole.fixed, &studies::FixedWholeRun::evaluationCost);
    const auto seconds = bestBy(whole.fixed, &studies::FixedWholeRun::seconds);
    return fmt::format("{:10} {:6g} {:5.2f} {:5.2f}  {:7.0f} {:6.0f} {:8.3f}  {}  {}\n", whole.name, whole.wanted,
                       whole.meanError / whole.wanted, whole.largestError / whole.wanted, whole.runEvaluations,
                       whole.trialEvaluations, whole.seconds,
                       bestText(evaluations, evaluations ? whole.evaluationCost() / evaluations->evaluationCost : 0.0),
                       bestText(seconds, seconds ? whole.seconds / seconds->seconds : 0.0));
}

}  // namespace

void studyWhole(const AccuracyOptions& options) {
    const std::vector<WholeSubject> subjects = wholeSubjectsOf(options);
    std::vector<fs::path> inputs;
    for (const WholeSubject& subject : subjects)
        inputs.insert(inputs.end(), subject.scene.files.begin(), subject.scene.files.end());
    prepareFolder(options, inputs);
    std::vector<studies::WholeScene> results;
    std::string summary =
        "scene      wanted; error over it, mean, largest; evaluations, of trial runs, seconds; over best fixed in "
        "evaluations, in seconds\n";
    for (const WholeSubject& subject : subjects) {
        results.push_back(measureSubject(subject, options));
        writeWholeTables(options.folder, results);  // written after each scene, because a later one may fail
        summary += wholeLineOf(results.back());
    }
    finishStudy(options, wholePage(results, {commandOf(options), threadCount(options.run), options.quick}),
                summary + studies::wholeSentence(results) + "\n");
}

}  // namespace tools
