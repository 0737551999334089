// The subcommands of the program, called by main(). Each function adds a command with its flags, its help, and the code
// that runs when it is called. Failures come back to main() as exceptions.
#pragma once

#include "tools/commands/command_line.h"
#include "tools/run/options.h"

namespace tools {

void addRenderCommand(CLI::App& program);
void addStripCommand(CLI::App& program);
void addSimulateCommand(CLI::App& program);
void addFiguresCommand(CLI::App& program);
void addVideoCommand(CLI::App& program);
void addCompareCommand(CLI::App& program);
void addApproveCommand(CLI::App& program);
void addCheckCommand(CLI::App& program);
void addScenesCommand(CLI::App& program);
void addSchemaCommand(CLI::App& program);
void addStudyCommand(CLI::App& program);
void addBenchCommand(CLI::App& program);
void addGenerateCommand(CLI::App& program);

/// Each function adds flags that several commands share to a command. Their values are read into the options.
void addTo(CLI::App& command, RunOptions& options);
void addTo(CLI::App& command, SceneOptions& options);
void addTo(CLI::App& command, DrawOptions& options);
/// @param fallback  the folder that is used without -o, named in the help
void addTo(CLI::App& command, FolderOptions& options, const std::string& fallback);
/// What the help of `render` and `simulate` says about error estimates.
inline constexpr const char* kErrorSampleNotes =
    "With a fixed step the error is estimated at up to 8 frames of a run. Each estimate takes about as long as\n"
    "simulating three frames; run.json has the cost of all of them as error_estimate.force_evaluations_spent.\n";

/// Adds only the flag --gl, the OpenGL backend, for commands that choose the size, style and quality of pictures
/// themselves.
void addBackendFlag(CLI::App& command, DrawOptions& options);

}  // namespace tools
