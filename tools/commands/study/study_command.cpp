// globular study: measures the program itself, with one subcommand for each question.
#include "tools/commands/study/study_command.h"

#include <fmt/format.h>

#include "tools/system/command_files.h"
#include "tools/system/gnuplot.h"
#include "tools/system/output_file.h"
#include "tools/system/process.h"
#include "tools/system/text.h"

namespace tools {

void addStudyFlags(CLI::App& command, StudyOptions& options, const std::string& quickHelp) {
    options.name = command.get_name();
    options.folder = "out/study-" + options.name;
    command.add_option("-o,--output", options.folder, fmt::format("folder to write to (default: {})", options.folder))
        ->type_name("DIR");
    command.add_flag("--quick", options.quick, quickHelp);
    addTo(command, options.run);
}

void prepareFolder(const StudyOptions& options, const std::vector<std::filesystem::path>& inputs) {
    const auto isWritten = [](const std::filesystem::path& file) {
        const std::string extension = file.extension().string();
        return extension == ".csv" || extension == ".svg" || extension == ".html";
    };
    requireSeparate({inputs, {}, {{"-o", options.folder, isWritten}}});
    createFolder(options.folder);
}

std::string operandOf(const std::string& scene) {
    return scene.size() > 1 && scene.starts_with('-') ? "./" + scene : scene;
}

std::string commandLineOf(const StudyOptions& options, const std::vector<std::string>& words) {
    std::vector<std::string> all = {"globular", "study", options.name};
    all.insert(all.end(), words.begin(), words.end());
    if (options.quick) all.emplace_back("--quick");
    all.insert(all.end(), {"--threads", fmt::format("{}", threadCount(options.run))});
    return shellLine(all);
}

void reportProgress(const StudyOptions& options, const Json& json, const std::string& line) {
    if (options.run.verbosity() == Verbosity::json) printJson(json);
    if (options.run.verbosity() == Verbosity::normal) printToStderr(line);
}

std::string writePlot(const StudyOptions& options, const std::string& fileName, const std::string& script) {
    std::string svg = drawWithGnuplot(script);
    writeFile(std::filesystem::path(options.folder) / fileName, svg);
    return svg;
}

void finishStudy(const StudyOptions& options, const std::string& page, const std::string& summary) {
    const std::string path = (std::filesystem::path(options.folder) / "index.html").string();
    writeFile(path, page);
    printResult(options.run, {{"event", "done"}, {"page", path}}, fmt::format("{}all of it: {}\n", summary, path));
}

void addStudyCommand(CLI::App& program) {
    CLI::App& study = *program.add_subcommand("study", "measurements: tables, plots, one page");
    study.require_subcommand(1);
    study.footer("Example: globular study accuracy liquid -o out/accuracy");
    addStudyAccuracy(study);
    addStudyMeshes(study);
    addStudyPictures(study);
    addStudyScaling(study);
    addStudyStability(study);
}

}  // namespace tools
