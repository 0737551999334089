// globular study accuracy: runs every stepper at a range of steps and measures its error against a reference. Writes
// tables, plots and a page.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <memory>
#include <set>

#include "engine/stepping/take_step.h"
#include "render/output/atomic_file.h"
#include "scenes/build/read_scene.h"
#include "scenes/text/input_error.h"
#include "studies/accuracy/accuracy.h"
#include "tools/commands/study/study_accuracy.h"
#include "tools/pages/study_pages.h"
#include "tools/system/output_file.h"
#include "tools/system/text.h"
#include "tools/system/threads.h"

namespace tools {
namespace {

namespace fs = std::filesystem;

/// Default length of the runs, in seconds of simulated time. Chosen: long enough for an impact, short enough that later
/// collisions do not multiply its errors.
constexpr double kWindow = 0.2;

/// Default start of the runs, as a share of the time of the scene's still. Chosen: the scene is in motion by then, and
/// has not yet come to what its still shows.
constexpr double kFromShare = 0.4;

/// What is measured: the steppers' accuracy in a scene over a window of simulated time.
struct Subject {
    std::string name;  ///< name in tables and of files: "measured-liquid", "hard-honey", "measured-powder-2s"
    scenes::Scene scene;
    double from = 0.0;    ///< start of the window, s
    double window = 0.0;  ///< length of the window, s
};

/// @throws scenes::InputError for a window that is shorter than a frame or has more frames than a run may have
void requireFrames(const Subject& subject, const std::string& text) {
    const double fps = subject.scene.fps.framesIn(1.0);
    const double most = scenes::Limits().frames;
    if (!(std::lround(std::min(subject.window * fps, most)) >= 1))
        throw scenes::InputError(
            text, fmt::format("a window of {:g} s is shorter than a frame of {:g} s", subject.window, 1.0 / fps));
    if (!((subject.from + subject.window) * fps <= most))
        throw scenes::InputError(
            text, fmt::format("a window that ends at {:g} s is beyond the {:g} frames that a run may have, {:g} s here",
                              subject.from + subject.window, most, most / fps));
}

/// Loads the scene of an argument "SCENE" or "SCENE:SECONDS"; the seconds are the length of the window.
Subject parseSubject(const std::string& text, const AccuracyOptions& options) {
    Subject subject;
    subject.window = options.window > 0.0 ? options.window : kWindow;
    std::string scene = text;
    std::string suffix;
    if (const std::size_t colon = text.rfind(':'); colon != std::string::npos) {
        const std::string seconds = text.substr(colon + 1);
        subject.window = parseNumber<double>(seconds).value_or(0.0);
        if (!(subject.window > 0.0))
            throw scenes::InputError(text, "after the colon comes how long to run, in seconds: measured/powder:2");
        scene = text.substr(0, colon);
        suffix = "-" + seconds + "s";
    }
    subject.name = subjectName(scene) + suffix;
    subject.scene = load({scene, options.overrides, {}});
    subject.from = options.from >= 0.0 ? options.from : kFromShare * subject.scene.stillTime;
    requireFrames(subject, text);
    return subject;
}

studies::AccuracySettings settingsFor(const Subject& subject, const AccuracyOptions& options) {
    const scenes::Scene& scene = subject.scene;
    studies::AccuracySettings settings;
    settings.firstFrame = static_cast<int>(std::lround(scene.fps.framesIn(subject.from)));
    settings.frameCount = static_cast<int>(std::lround(scene.fps.framesIn(subject.window)));
    if (options.quick) {
        settings.stepsPerFrame = {4, 8, 16, 32};
        settings.errors = {1e-1, 1e-2};
        settings.rounds = 1;
        settings.runLimit = 20.0;
        settings.referenceBudget = 20.0;
    }
    std::vector<double>& errors = settings.errors;
    const double own = scene.setup.error;
    if (scene.setup.stepper == engine::StepperKind::automatic && std::ranges::find(errors, own) == errors.end())
        errors.insert(std::ranges::lower_bound(errors, own, std::greater{}), own);
    return settings;
}

std::vector<Subject> subjectsOf(const AccuracyOptions& options) {
    std::vector<Subject> subjects;
    std::set<std::string> names;
    for (const std::string& text : options.scenes) {
        subjects.push_back(parseSubject(text, options));
        if (!names.insert(subjects.back().name).second)
            throw scenes::InputError(text, "two scenes would share its files");
    }
    return subjects;
}

studies::SceneAccuracy measure(const Subject& subject, const AccuracyOptions& options) {
    studies::SceneAccuracy accuracy;
    try {
        onThreads(threadCount(options.run), [&] {
            accuracy = studies::measureAccuracy(subject.name, subject.scene, settingsFor(subject, options),
                                                runReporter(options, subject.name));
        });
    } catch (const engine::InstabilityError& error) {
        throw engine::InstabilityError(subject.name + ": " + error.what());
    }
    return accuracy;
}

void writeTables(const fs::path& folder, const std::vector<studies::SceneAccuracy>& results) {
    writeFile(folder / "accuracy.csv", studies::accuracyCsv(results));
    writeFile(folder / "orders.csv", studies::ordersCsv(results));
    writeFile(folder / "auto.csv", studies::autosCsv(results));
    writeFile(folder / "references.csv", studies::referencesCsv(results));
}

AccuracySection sectionOf(const AccuracyOptions& options, const studies::SceneAccuracy& accuracy) {
    return {
        accuracy,
        writePlot(options, accuracy.name + "-seconds.svg", studies::accuracyPlot(accuracy, studies::CostAxis::seconds)),
        writePlot(options, accuracy.name + "-evaluations.svg",
                  studies::accuracyPlot(accuracy, studies::CostAxis::forceEvaluations))};
}

std::string ratio(const std::optional<studies::HandPicked>& picked, double cost) {
    return picked ? fmt::format("{:.2f}", cost / picked->cost) : "-";
}

/// Text for the terminal: orders of the fixed steppers, and how the automatic stepper compares with the best of them.
std::string summaryOf(const studies::SceneAccuracy& accuracy) {
    std::string text = fmt::format("{}: reference {} at {:.3g} s, resolves {:.1e} radii\n", accuracy.name,
                                   engine::nameOf(accuracy.reference.variant.stepper), accuracy.reference.variant.asked,
                                   accuracy.reference.resolution);
    for (const studies::OrderRow& row : accuracy.orders)
        if (row.order) text += fmt::format("  {:17} order {:.2f}\n", engine::nameOf(row.stepper), *row.order);
    text += "  auto: asked  obtained  seconds  over best hand-picked at the error obtained, asked; in evaluations\n";
    for (const studies::AutoRow& row : accuracy.autos)
        text += fmt::format(
            "      {:7g}  {:8.1e}  {:7.3g}  {:>5} {:>5}  {:>5} {:>5}\n", row.asked, row.obtained, row.seconds,
            ratio(row.secondsAtObtained, row.seconds), ratio(row.secondsAtAsked, row.seconds),
            ratio(row.evaluationsAtObtained, row.evaluationCost), ratio(row.evaluationsAtAsked, row.evaluationCost));
    return text;
}

void study(const AccuracyOptions& options) {
    const fs::path folder = options.folder;
    const std::vector<Subject> subjects = subjectsOf(options);
    std::vector<fs::path> inputs;
    for (const Subject& subject : subjects)
        inputs.insert(inputs.end(), subject.scene.files.begin(), subject.scene.files.end());
    prepareFolder(options, inputs);
    std::vector<studies::SceneAccuracy> results;
    for (const Subject& subject : subjects) {
        results.push_back(measure(subject, options));
        writeTables(folder, results);  // written after each scene, because a later one may fail
    }
    std::vector<AccuracySection> sections;
    std::string summary;
    for (const studies::SceneAccuracy& accuracy : results) {
        sections.push_back(sectionOf(options, accuracy));
        summary += summaryOf(accuracy);
    }
    finishStudy(options, accuracyPage(sections, {commandOf(options), threadCount(options.run), options.quick}),
                summary);
}

}  // namespace

std::string subjectName(const std::string& scene) {
    constexpr std::size_t kRoom = 50;  // bytes of a file's name, for the window and what its plot shows
    std::string name = render::shortenedName(runName({scene, {}, {}}), kRoom);
    std::ranges::replace(name, '/', '-');
    return name;
}

studies::RunListener runReporter(const AccuracyOptions& options, const std::string& scene) {
    return [&options, scene](const studies::WindowRun& run, std::string_view purpose) {
        const std::string stepper = studies::nameOf(run.variant);
        reportProgress(options,
                       {{"event", purpose},
                        {"scene", scene},
                        {"stepper", stepper},
                        {"asked", run.variant.asked},
                        {"ending", studies::nameOf(run.ending)},
                        {"seconds", run.seconds}},
                       fmt::format("{}: {} {} {:.4g}, {} steps, {:.3g} s, {}\n", scene, purpose, stepper,
                                   run.variant.asked, run.steps.count, run.seconds, studies::nameOf(run.ending)));
    };
}

std::string commandOf(const AccuracyOptions& options) {
    std::vector<std::string> words;
    if (options.whole) words.emplace_back("--whole");
    for (const std::string& scene : options.scenes) words.push_back(operandOf(scene));
    for (const std::string& text : options.overrides) words.insert(words.end(), {"--set", text});
    if (options.from >= 0.0) words.insert(words.end(), {"--from", fmt::format("{:g}", options.from)});
    if (options.window > 0.0) words.insert(words.end(), {"--window", fmt::format("{:g}", options.window)});
    return commandLineOf(options, words);
}

void addStudyAccuracy(CLI::App& program) {
    CLI::App& command = *program.add_subcommand("accuracy", "speed against error: every stepper against a reference");
    const auto options = std::make_shared<AccuracyOptions>();
    command.add_option(
        "SCENE", options->scenes,
        "scene files or names, each with a window of its own as in measured/powder:2 (default: liquid solid powder "
        "fountain honey of measured/; powder:2 too unless quick; with --whole all of measured/)");
    CLI::Option* whole = command.add_flag(
        "--whole", options->whole, "whole scenes instead of windows: auto against the best fixed stepper and step");
    command.add_option("--set", options->overrides, "change a key of every scene")
        ->type_name("KEY=VALUE")
        ->allow_extra_args(false);
    command.add_option("--from", options->from, "where the runs start, s (default: 0.4 of the scene's still time)")
        ->check(numberAtLeastZero())
        ->excludes(whole);
    command.add_option("--window", options->window, "how long they run, s (default: 0.2)")
        ->check(numberAboveZero())
        ->excludes(whole);
    addStudyFlags(command, *options, "a coarse measurement: fewer runs, timed once");
    command.footer("Example: globular study accuracy measured/liquid measured/powder -o out/accuracy --threads 2");
    command.callback([options] {
        std::vector<std::string>& scenes = options->scenes;
        if (scenes.empty()) {
            scenes = {"measured/liquid", "measured/solid", "measured/powder", "measured/fountain", "measured/honey"};
            // Two seconds of a powder are long enough for chaos, so that statistics are compared instead of positions.
            if (options->whole)
                scenes.insert(scenes.end(), {"measured/lava", "measured/mud", "measured/sand", "measured/cascade",
                                             "measured/splash"});
            else if (!options->quick)
                scenes.emplace_back("measured/powder:2");
        }
        options->whole ? studyWhole(*options) : study(*options);
    });
}

}  // namespace tools
