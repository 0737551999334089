// The subcommands of the program, added by main(), and what they add to CLI11: flags that several of them share, checks
// of numbers, and messages that suggest the nearest known name.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "tools/run/options.h"
#include "tools/run/simulation_host.h"

namespace tools {

/// Each function adds a command with its flags, its help, and the code that runs when it is called. Failures of that
/// code come back to main() as exceptions.
void addRenderCommand(CLI::App& program);
void addStripCommand(CLI::App& program);
/// @param host  computes the simulation; nullptr: this process
void addSimulateCommand(CLI::App& program, SimulationHost* host = nullptr);
void addMeshCommand(CLI::App& program);
void addFiguresCommand(CLI::App& program);
void addGalleryCommand(CLI::App& program);
void addVideoCommand(CLI::App& program);
void addAssembleCommand(CLI::App& program);
void addCompareCommand(CLI::App& program);
void addApproveCommand(CLI::App& program);
void addCheckCommand(CLI::App& program);
void addPlotCommand(CLI::App& program);
void addDevicesCommand(CLI::App& program);
void addScenesCommand(CLI::App& program);
void addSchemaCommand(CLI::App& program);
void addStudyCommand(CLI::App& program);
void addBenchCommand(CLI::App& program);
void addGenerateCommand(CLI::App& program);

/// Each function adds flags that several commands share to a command. Their values are read into the options.
void addTo(CLI::App& command, RunOptions& options);
void addTo(CLI::App& command, SceneOptions& options);
void addTo(CLI::App& command, DrawOptions& options);
/// @param help  of -o, with the folder that is used without it
void addTo(CLI::App& command, FolderOptions& options, const std::string& help);
/// Adds the flag --strict.
void addStrictFlag(CLI::App& command, SceneOptions& options);
/// Adds the flag --no-error-estimate, which makes `estimatesErrors` false.
void addErrorFlag(CLI::App& command, bool& estimatesErrors);
/// Adds the flag --format of a list of formats, whose help names them all. The value that `chosen` has is the default.
/// @param formats  each with a name and a help
template <class Formats>
void addFormats(CLI::App& command, const Formats& formats, std::vector<std::string>& chosen) {
    std::vector<std::string> names;
    std::string help = "what to write, one file a frame of each, separated by commas (default: " + chosen.front() + ")";
    for (const auto& format : formats) {
        names.emplace_back(format.name);
        help += "; " + names.back() + ": " + std::string(format.help);
    }
    command.add_option("--format", chosen, help)
        ->type_name("FORMATS")
        ->delimiter(',')
        ->allow_extra_args(false)
        ->check(CLI::IsMember(names));
}
/// What the help of `render` and `simulate` says about error estimates.
inline constexpr const char* kErrorSampleNotes =
    "With a fixed step the error is estimated at up to 8 frames of a run, unless --no-error-estimate is given. That\n"
    "takes at most a tenth of the run's force evaluations; run.json counts them in steps.force_evaluations, and again\n"
    "as steps.force_evaluations_of_error_estimates.\n";

/// Adds only the flags --renderer and --gl, for commands that choose the size, style and quality of pictures
/// themselves. The default of --renderer is the value that the options have.
void addRendererFlags(CLI::App& command, DrawOptions& options);
/// Adds only the flag --gl.
void addDeviceFlag(CLI::App& command, DrawOptions& options);

/// Checks that the value of a flag is a finite number: from least to most, both included, at least 0, or above 0.
/// CLI11's own checks accept NaN and infinity, and their messages name the largest double as the upper bound.
CLI::Validator numberFrom(double least, double most);
CLI::Validator numberAtLeastZero();
CLI::Validator numberAboveZero();

/// Prepares memory, standard streams and folders of the process; the first thing that a program does.
void prepareProcess();

/// Runs the command that was called; returns the exit code of the program, and has printed a line for each problem.
int runProgram(CLI::App& program, int argc, char** argv);

/// Runs the command that was called, or prints what --help or another flag of the program asks for.
/// @throws ExitStatus with kInputErrorCode if there is no command or a flag is wrong, and whatever the command throws
void runCommandLine(CLI::App& program, int argc, char** argv);

}  // namespace tools
