// globular study: measures the program itself, with one subcommand for each question.
#include "tools/commands/study_command.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "tools/system/output_file.h"
#include "tools/system/process.h"
#include "tools/system/text.h"

namespace tools {

void addStudyFlags(CLI::App& command, StudyOptions& options, const std::string& quickHelp) {
    options.folder = "out/study-" + options.name;
    command
        .add_option("-o,--output", options.folder,
                    fmt::format("folder to write to (default: out/study-{})", options.name))
        ->type_name("DIR");
    command.add_flag("--quick", options.quick, quickHelp);
    addTo(command, options.run);
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
    addStudyPictures(study);
    addStudyScaling(study);
    addStudyStability(study);
}

}  // namespace tools
