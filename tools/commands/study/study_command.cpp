// globular study: measures the program itself, with one subcommand for each question.
#include "tools/commands/study/study_command.h"

#include <fmt/format.h>

#include <string_view>

#include "render/output/child_process.h"
#include "render/picture/system_error.h"
#include "tools/system/command_files.h"
#include "tools/system/output_file.h"
#include "tools/system/process.h"
#include "tools/system/text.h"

namespace tools {
namespace {

render::ChildProcess startGnuplot() {
    try {
        return render::ChildProcess({"gnuplot", "-"});
    } catch (const render::ProgramMissing& error) {
        throw render::SystemError(fmt::format("{}; install gnuplot (Debian: gnuplot-nox) for the plots", error.what()));
    }
}

}  // namespace

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

// The script is piped to gnuplot and the SVG is read from its output, so that gnuplot writes no files.
std::string writePlot(const StudyOptions& options, const std::string& fileName, const std::string& script) {
    render::ChildProcess gnuplot = startGnuplot();
    const bool taken = gnuplot.write({reinterpret_cast<const std::uint8_t*>(script.data()), script.size()});
    const std::string ending = gnuplot.wait();
    constexpr std::size_t kMostBytes = 64U << 20;  // limit on gnuplot's output; the plots take about 50 kB
    const std::string output = gnuplot.output(kMostBytes);
    constexpr std::string_view kEnd = "</svg>";
    const std::size_t first = output.find("<?xml");
    const std::size_t last = output.rfind(kEnd);
    const bool whole = first != std::string::npos && last != std::string::npos;
    // Output before the picture consists of warnings.
    if (!taken || !ending.empty() || !whole)
        throw render::SystemError(
            fmt::format("gnuplot ended with {}: {}", ending.empty() ? "no plot" : ending, output.substr(0, first)));
    const std::string svg = output.substr(first, last + kEnd.size() - first) + "\n";
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
