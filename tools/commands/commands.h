// The subcommands of the program, called by main(). Each function adds a command with its flags, its help, and the code
// that runs when it is called. Failures come back to main() as exceptions.
#pragma once

#include "tools/commands/command_line.h"
#include "tools/run/options.h"

namespace tools {

void addRenderCommand(const Command& program);
void addStripCommand(const Command& program);
void addSimulateCommand(const Command& program);
void addFiguresCommand(const Command& program);
void addVideoCommand(const Command& program);
void addCompareCommand(const Command& program);
void addApproveCommand(const Command& program);
void addCheckCommand(const Command& program);
void addScenesCommand(const Command& program);
void addSchemaCommand(const Command& program);
void addStudyCommand(const Command& program);
void addBenchCommand(const Command& program);
/// @param version  "globular 0.3.0", for the man page
void addGenerateCommand(const Command& program, const std::string& version);

/// Adds the flags that several commands share, to be read into the options.
void addTo(const Command& command, RunOptions& options);
void addTo(const Command& command, SceneOptions& options);
void addTo(const Command& command, DrawOptions& options);
/// @param fallback  the folder without -o, for the help
void addTo(const Command& command, FolderOptions& options, const std::string& fallback);
/// What the help of `render` and `simulate` says about error estimates.
inline constexpr const char* kErrorSampleNotes =
    "With a fixed step the error is estimated at up to 8 frames of a run. Each estimate takes about as long as\n"
    "simulating three frames; run.json has the cost of all of them as error_estimate.force_evaluations_spent.";

/// Adds --gl alone, for commands that choose size, style and quality themselves.
void addBackendFlag(const Command& command, DrawOptions& options);

}  // namespace tools
