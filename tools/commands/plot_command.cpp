// globular plot: draws what the obstacles of a run have felt over time, from its loads.csv.
#include <fmt/format.h>

#include <filesystem>
#include <map>
#include <memory>
#include <vector>

#include "scenes/text/input_error.h"
#include "tools/commands/commands.h"
#include "tools/frames/frame_names.h"
#include "tools/loads/load_plot.h"
#include "tools/system/command_files.h"
#include "tools/system/json.h"
#include "tools/system/output_file.h"

namespace tools {
namespace {

namespace fs = std::filesystem;

struct PlotOptions {
    RunOptions run;
    std::string input;           ///< loads.csv, or the folder that it is in
    std::string output;          ///< empty: loads.svg beside the input
    std::vector<int> obstacles;  ///< numbers of those to draw; empty: all
};

/// The loads.csv that is meant.
fs::path tableOf(const PlotOptions& options) {
    if (!fs::is_directory(options.input)) return options.input;
    const fs::path table = fs::path(options.input) / kLoadsName;
    if (!fs::exists(table))
        throw scenes::InputError(options.input,
                                 fmt::format("there is no {} in it; a run writes one if an obstacle of its scene moves "
                                             "or has record = true",
                                             kLoadsName));
    return table;
}

PlotFormat formatOf(const fs::path& output) {
    if (output.extension() == ".svg") return PlotFormat::svg;
    if (output.extension() == ".png") return PlotFormat::png;
    throw scenes::InputError("-o " + output.string(), "the name must end in .svg or .png");
}

/// What run.json beside a table says of the run; an empty object if there is none.
Json reportBeside(const fs::path& table) {
    const fs::path file = table.parent_path() / "run.json";
    Json json = fs::exists(file) ? Json::parse(readFile(file), nullptr, false) : Json();
    return json.is_object() ? json : Json::object();
}

/// How an obstacle is called: with its shape, if the report of the run has it.
std::string nameOf(int obstacle, const Json& report) {
    for (const Json& each : report.value("obstacles", Json::array()))
        if (each.is_object() && each.value("obstacle", Json()) == obstacle && each.value("shape", Json()).is_string())
            return fmt::format("obstacle {} ({})", obstacle, each["shape"].get<std::string>());
    return fmt::format("obstacle {}", obstacle);
}

/// The names of the obstacles to draw.
std::map<int, std::string> namesOf(const PlotOptions& options, const LoadsOverTime& loads, const Json& report) {
    std::map<int, std::string> names;
    for (const auto& [obstacle, points] : loads) names[obstacle] = nameOf(obstacle, report);
    if (options.obstacles.empty()) return names;
    std::map<int, std::string> chosen;
    for (const int obstacle : options.obstacles) {
        if (!names.contains(obstacle)) {
            std::vector<int> known;
            for (const auto& [each, name] : names) known.push_back(each);
            throw scenes::InputError(fmt::format("--obstacle {}", obstacle),
                                     fmt::format("there are loads of {} alone", fmt::join(known, ", ")));
        }
        chosen[obstacle] = names[obstacle];
    }
    return chosen;
}

void plot(PlotOptions options) {
    const fs::path table = tableOf(options);
    if (options.output.empty()) options.output = fs::path(table).replace_extension(".svg").string();
    LoadFigure figure;
    figure.format = formatOf(options.output);
    requireSeparate({{table, table.parent_path() / "run.json"}, {{"-o", options.output}}, {}});
    const LoadsOverTime loads = readLoads(table);
    const Json report = reportBeside(table);
    figure.names = namesOf(options, loads, report);
    if (report.value("scene", Json()).is_string()) figure.title = report["scene"].get<std::string>();
    const std::string drawn = drawWithGnuplot(loadPlotScript(loads, figure), figure.format);
    createFolderOf(options.output);
    writeFile(options.output, drawn);
    Json obstacles = Json::array();
    for (const auto& [obstacle, name] : figure.names) obstacles.push_back(obstacle);
    printResult(options.run, {{"event", "done"}, {"plot", options.output}, {"obstacles", obstacles}},
                fmt::format("{}\n", options.output));
}

}  // namespace

void addPlotCommand(CLI::App& program) {
    CLI::App& command = *program.add_subcommand("plot", "force, torque and work of the obstacles of a run over time");
    const auto options = std::make_shared<PlotOptions>();
    command.add_option("RUN", options->input, "the folder of a run, or the loads.csv in it")->required();
    command
        .add_option("-o,--output", options->output,
                    "the figure to write; the name must end in .svg or .png (default: loads.svg beside loads.csv)")
        ->type_name("FILE");
    command.add_option("--obstacle", options->obstacles, "draw this obstacle alone, or several; the first one is 1")
        ->type_name("K")
        ->delimiter(',')
        ->allow_extra_args(false);
    addTo(command, options->run);
    command.footer(
        "A run writes loads.csv if an obstacle of its scene moves or has record = true. Needs gnuplot.\n"
        "Example: globular plot out/stirrer -o stirrer.png --obstacle 2");
    command.callback([options] { plot(*options); });
}

}  // namespace tools
